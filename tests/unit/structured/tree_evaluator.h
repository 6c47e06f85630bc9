#pragma once

#include "structured/meaning/symbols.h"
#include "structured/text/link_blocks.h"
#include "structured/text/program.h"
#include "structured/text/structured_words.h"
#include "tests/unit/vm/basic_run.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace orb::structured {

/// The simplest evaluator of structured orbBasic: walks the statements and their expression trees
/// and keeps values by name. Deliberately slow; compiled programs must agree with it.
class TreeEvaluator {
public:
  TreeEvaluator(const Program& program, const Names& names, vm::NotebookHost& host,
                std::uint64_t seed)
      : program_(program), names_(names), host_(host), seeds_(mix(seed)),
        values_(names.symbols.size(), 0) {
    done.resize(program.statements.size());
    elements_.fill(0);
    seeds_ += 0x9E3779B97F4A7C15U;
    random_ = mix(seeds_);
  }

  /// Runs the main program, at most `most` statements.
  void run(std::uint64_t most) {
    most_ = most;
    try {
      const auto& main = program_.files.front();
      if (block(main.statements_begin, main.statements_end) == Way::On)
        end = "end";
      else if (end.empty())
        end = "end";
    } catch (spec::BasicError error) {
      end = std::string(spec::info(error).text);
    } catch (Stopped) {
      if (end.empty())
        end = "running";
    }
  }

  /// Returns the value of a global variable.
  std::int32_t value_of(std::uint32_t symbol) const { return values_[symbol]; }

  std::vector<bool> done;      ///< of each statement without a block: it has completed
  std::string end;             ///< `end`, the robot's error, or `running`
  std::uint32_t statement = 0; ///< the last one started
  std::uint64_t steps = 0;

private:
  struct Stopped {};
  enum class Way : std::uint8_t { On, Exit, Again, Return, Goto };
  using Error = spec::BasicError;

  static std::uint64_t mix(std::uint64_t value) {
    value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9U;
    value = (value ^ value >> 27) * 0x94D049BB133111EBU;
    return value ^ value >> 31;
  }
  static std::int32_t wrap(std::int64_t value) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value)));
  }
  const Statement& at(std::uint32_t i) const { return program_.statements[i]; }
  const Item& item(const Statement& node, std::uint32_t n) const {
    return program_.items[node.items_begin + n];
  }
  static std::uint32_t size(const Statement& node) { return node.items_end - node.items_begin; }

  // ---- expressions

  /// Returns the operands of a node from left to right.
  std::vector<std::uint32_t> operands(std::uint32_t n) const {
    std::vector<std::uint32_t> list;
    for (auto last = n; last > program_.nodes[n].first;) {
      list.insert(list.begin(), last - 1);
      last = program_.nodes[last - 1].first;
    }
    return list;
  }

  std::int32_t value(std::uint32_t n) {
    const auto& node = program_.nodes[n];
    const auto parts = operands(n);
    switch (node.kind) {
    case NodeKind::Number: return node.value;
    case NodeKind::Duration: return seconds_ ? node.value / 1000 : node.value;
    case NodeKind::Name: {
      const auto& symbol = names_.symbols[names_.of_node[n]];
      return symbol.kind == SymbolKind::Constant ? symbol.value : values_[names_.of_node[n]];
    }
    case NodeKind::System: return host_.read(static_cast<spec::Variable>(node.what), {});
    case NodeKind::Element: return element(n, value(n - 1));
    case NodeKind::Call: return call(names_.of_node[n], parts);
    case NodeKind::Builtin: return builtin(static_cast<spec::Function>(node.what), value(n - 1));
    case NodeKind::Least:
    case NodeKind::Greatest: {
      const auto a = value(parts[0]);
      const auto b = value(parts[1]);
      return node.kind == NodeKind::Least ? std::min(a, b) : std::max(a, b);
    }
    case NodeKind::Negate: return wrap(-std::int64_t{value(n - 1)});
    case NodeKind::Binary: {
      const auto a = value(parts[0]);
      const auto b = value(parts[1]);
      return combine(static_cast<spec::Operator>(node.what), a, b);
    }
    case NodeKind::Relation:
    case NodeKind::Not:
    case NodeKind::And:
    case NodeKind::Or: return holds(n) ? 1 : 0;
    }
    return 0;
  }

  bool holds(std::uint32_t n) {
    const auto& node = program_.nodes[n];
    const auto parts = operands(n);
    if (node.kind == NodeKind::Not)
      return !holds(n - 1);
    if (node.kind == NodeKind::And)
      return holds(parts[0]) && holds(parts[1]);
    if (node.kind == NodeKind::Or)
      return holds(parts[0]) || holds(parts[1]);
    if (node.kind != NodeKind::Relation)
      return value(n) != 0;
    const auto a = value(parts[0]);
    const auto b = value(parts[1]);
    switch (static_cast<Comparison>(node.what)) {
    case Comparison::Equal: return a == b;
    case Comparison::NotEqual: return a != b;
    case Comparison::Less: return a < b;
    case Comparison::Greater: return a > b;
    case Comparison::LessEqual: return a <= b;
    case Comparison::GreaterEqual: return a >= b;
    }
    return false;
  }

  static std::int32_t combine(spec::Operator op, std::int32_t x, std::int32_t y) {
    const std::int64_t a = x;
    const std::int64_t b = y;
    const auto count = [&] {
      if (b < 0 || b > 31)
        throw Error::BadNumericParameter;
      return b;
    };
    const auto divisor = [&] {
      if (b == 0)
        throw Error::DivideByZero;
      return b;
    };
    switch (op) {
    case spec::Operator::Multiply: return wrap(a * b);
    case spec::Operator::Divide: return wrap(a / divisor());
    case spec::Operator::Remainder: return wrap(a % divisor());
    case spec::Operator::ShiftLeft: return wrap(a * (std::int64_t{1} << count()));
    case spec::Operator::ShiftRight: return wrap(a >> count());
    case spec::Operator::Add: return wrap(a + b);
    case spec::Operator::Subtract: return wrap(a - b);
    case spec::Operator::And: return x & y;
    case spec::Operator::Or: return x | y;
    }
    return 0;
  }

  std::int32_t builtin(spec::Function function, std::int32_t x) {
    if (function == spec::Function::Abs)
      return x < 0 ? wrap(-std::int64_t{x}) : x;
    if (function == spec::Function::Sqrt) {
      if (x < 0)
        throw Error::BadNumericParameter;
      std::int64_t root = 0;
      while ((root + 1) * (root + 1) <= x)
        ++root;
      return static_cast<std::int32_t>(root);
    }
    if (x < 1)
      throw Error::BadNumericParameter;
    random_ += 0x9E3779B97F4A7C15U;
    return 1 +
           static_cast<std::int32_t>((mix(random_) >> 32) * static_cast<std::uint64_t>(x) >> 32);
  }

  std::int32_t& element(std::uint32_t n, std::int32_t index) {
    const auto& symbol = names_.symbols[names_.of_node[n]];
    if (index < 1 || index > symbol.value)
      throw Error::IllegalIndex;
    return elements_[static_cast<std::size_t>(symbol.base + index - 1)];
  }

  std::int32_t call(std::uint32_t symbol, const std::vector<std::uint32_t>& arguments) {
    std::vector<std::int32_t> values;
    for (const auto argument : arguments)
      values.push_back(value(argument));
    const auto& routine = names_.routines[names_.symbols[symbol].routine];
    for (std::uint32_t n = 0; n < values.size(); ++n)
      values_[routine.first_parameter + n] = values[n];
    for (const auto local : routine.locals)
      values_[local] = 0;
    const auto caller = statement;
    result_ = 0;
    const auto way = block(routine.statement + 1, at(routine.statement).next);
    const auto result = way == Way::Return ? result_ : 0;
    statement = caller;
    return result;
  }

  // ---- statements

  Way block(std::uint32_t from, std::uint32_t to) {
    for (auto i = from; i < to;) {
      const auto way = execute(i);
      if (way == Way::Goto && from <= target_ && target_ < to)
        i = target_;
      else if (way != Way::On)
        return way;
    }
    return Way::On;
  }

  /// Executes a statement or a whole block and moves past it.
  Way execute(std::uint32_t& i) {
    const auto node = at(i);
    const auto here = i;
    i = here + 1;
    if (++steps > most_)
      throw Stopped{};
    statement = here;
    if (node.kind == Kind::Assign)
      assign(node);
    if (node.kind == Kind::Print)
      print(node);
    if (node.kind == Kind::Robot)
      robot(node);
    if (node.kind == Kind::Call) {
      std::vector<std::uint32_t> arguments;
      for (std::uint32_t n = 0; n < size(node); ++n)
        arguments.push_back(item(node, n).value);
      call(names_.of_statement[here], arguments);
    }
    done[here] = true;
    if (node.kind == Kind::Return) {
      result_ = size(node) > 0 ? value(item(node, 0).value) : 0;
      return Way::Return;
    }
    if (node.kind == Kind::Exit)
      return Way::Exit;
    if (node.kind == Kind::Continue)
      return Way::Again;
    if (node.kind == Kind::Goto) {
      target_ = label(here);
      return Way::Goto;
    }
    if (node.kind == Kind::Sub || node.kind == Kind::Function)
      i = node.next + 1;
    if (node.kind == Kind::If)
      return conditional(i, here);
    if (node.kind == Kind::Select)
      return selection(i, here);
    if (is_loop(node.kind)) {
      i = node.next + 1;
      return loop(here);
    }
    return Way::On;
  }

  /// Finds the label of a `goto`: in its routine, and not inside a block that does not contain the
  /// `goto`.
  std::uint32_t label(std::uint32_t jump) const {
    for (std::uint32_t i = 0; i < program_.statements.size(); ++i)
      if (at(i).kind == Kind::Label && at(i).name == at(jump).name &&
          names_.routine_of[i] == names_.routine_of[jump])
        return i;
    return none;
  }

  Way conditional(std::uint32_t& i, std::uint32_t here) {
    auto last_part = here;
    while (at(last_part).kind != Kind::EndIf)
      last_part = at(last_part).next;
    i = last_part + 1;
    for (auto part = here; part != last_part; part = at(part).next) {
      statement = part;
      if (at(part).kind == Kind::Else || holds(item(at(part), 0).value))
        return block(part + 1, at(part).next);
    }
    return Way::On;
  }

  Way selection(std::uint32_t& i, std::uint32_t here) {
    const auto chosen = value(item(at(here), 0).value);
    auto last_part = here;
    while (at(last_part).kind != Kind::EndSelect)
      last_part = at(last_part).next;
    i = last_part + 1;
    for (auto part = at(here).next; part != last_part; part = at(part).next)
      if (at(part).kind == Kind::Else || matches(at(part), chosen))
        return block(part + 1, at(part).next);
    return Way::On;
  }

  bool matches(const Statement& node, std::int32_t chosen) {
    for (std::uint32_t n = 0; n < size(node); ++n) {
      const auto lo = value(item(node, n).value);
      auto hi = lo;
      if (n + 2 < size(node) && item(node, n + 1).kind == ItemKind::To) {
        hi = value(item(node, n + 2).value);
        n += 2;
      }
      if (lo <= chosen && chosen <= hi)
        return true;
    }
    return false;
  }

  Way loop(std::uint32_t here) {
    const auto& node = at(here);
    const auto last_part = node.next;
    std::int32_t times = 0;
    std::int32_t last = 0;
    std::int32_t step = 1;
    std::uint32_t counter = none;
    if (node.kind == Kind::RepeatTimes)
      times = value(item(node, 0).value);
    if (node.kind == Kind::For) {
      counter = names_.of_node[item(node, 0).value];
      values_[counter] = value(item(node, 1).value);
      last = value(item(node, 2).value);
      step = size(node) > 3 ? value(item(node, 3).value) : 1;
    }
    for (;;) {
      if (++steps > most_)
        throw Stopped{};
      statement = here;
      if (node.kind == Kind::While && !holds(item(node, 0).value))
        return Way::On;
      if (node.kind == Kind::RepeatTimes && times-- < 1)
        return Way::On;
      if (node.kind == Kind::For && (step > 0 ? values_[counter] > last : values_[counter] < last))
        return Way::On;
      const auto way = block(here + 1, last_part);
      if (way == Way::Return || way == Way::Goto)
        return way;
      if (way == Way::Exit)
        return Way::On;
      statement = last_part;
      if (node.kind == Kind::Repeat && holds(item(at(last_part), 0).value))
        return Way::On;
      if (node.kind == Kind::For)
        values_[counter] = wrap(std::int64_t{values_[counter]} + step);
    }
  }

  void assign(const Statement& node) {
    const auto place = item(node, 0).value;
    const auto root = item(node, 1).value;
    const auto op = static_cast<spec::Operator>(node.operation);
    const bool compound = node.operation != Statement::none_operation;
    const auto kind = program_.nodes[place].kind;
    if (kind == NodeKind::Element) {
      const auto index = value(place - 1);
      const auto old = compound ? element(place, index) : 0;
      const auto right = value(root);
      const auto result = compound ? combine(op, old, right) : right;
      element(place, index) = result;
    } else if (kind == NodeKind::System) {
      const auto variable = static_cast<spec::Variable>(program_.nodes[place].what);
      const auto old = compound ? host_.read(variable, {}) : 0;
      const auto right = value(root);
      host_.write(variable, compound ? combine(op, old, right) : right, {});
    } else {
      const auto symbol = names_.of_node[place];
      const auto old = values_[symbol];
      const auto right = value(root);
      values_[symbol] = compound ? combine(op, old, right) : right;
    }
  }

  void print(const Statement& node) {
    std::string text;
    bool open = false;
    for (std::uint32_t n = 0; n < size(node); ++n) {
      const auto& part = item(node, n);
      open = part.kind == ItemKind::Semicolon;
      if (part.kind == ItemKind::Expression)
        text += std::to_string(value(part.value));
      else if (part.kind == ItemKind::Character)
        text += static_cast<char>(static_cast<unsigned char>(value(part.value)));
      else if (part.kind == ItemKind::Comma)
        text += ' ';
      else if (part.kind == ItemKind::String)
        text += program_.text_of({part.span.begin + 1, part.span.end - 1});
    }
    host_.print(text + (open ? "" : "\n"), {});
  }

  void set(std::uint32_t place, std::int32_t value_set, std::int32_t index) {
    if (program_.nodes[place].kind == NodeKind::Element)
      element(place, index) = value_set;
    else
      values_[names_.of_node[place]] = value_set;
  }

  void robot(const Statement& node) {
    using S = spec::Statement;
    if (node.robot == S::End) {
      end = "end";
      throw Stopped{};
    }
    if (node.robot == S::Read) {
      for (std::uint32_t n = 0; n < size(node); ++n) {
        const auto place = item(node, n).value;
        const bool indexed = program_.nodes[place].kind == NodeKind::Element;
        const auto index = indexed ? value(place - 1) : 0;
        if (data_next_ == data_.size())
          throw Error::OutOfData;
        const auto taken = data_[data_next_++];
        set(place, taken, index);
      }
      return;
    }
    if (node.robot == S::Input) {
      const auto place = item(node, 0).value;
      const bool indexed = program_.nodes[place].kind == NodeKind::Element;
      const auto index = indexed ? value(place - 1) : 0;
      if (size(node) < 3) {
        end = "running";
        throw Stopped{};
      }
      in_range(value(item(node, 1).value), spec::info(S::Input).parameters()[0]);
      set(place, value(item(node, 2).value), index);
      return;
    }
    std::vector<std::int32_t> values;
    if (node.robot == S::Rgb && size(node) == 1) {
      const auto& part = item(node, 0);
      const auto colour =
          part.kind == ItemKind::Colour ? part.value : *find_colour(program_.text_of(part.span));
      values = {static_cast<std::int32_t>(colour >> 16),
                static_cast<std::int32_t>(colour >> 8 & 255),
                static_cast<std::int32_t>(colour & 255)};
    } else {
      for (std::uint32_t n = 0; n < size(node); ++n) {
        seconds_ = node.robot == S::Sleep && n == 0;
        values.push_back(value(item(node, n).value));
        seconds_ = false;
      }
    }
    if (node.robot == S::Data) {
      data_ = values;
      data_next_ = 0;
      return;
    }
    if (node.robot == S::Rstr) {
      data_next_ = 0;
      return;
    }
    if (node.robot == S::Random) {
      seeds_ += 0x9E3779B97F4A7C15U;
      random_ = mix(seeds_);
      return;
    }
    const auto parameters = spec::info(node.robot).parameters();
    for (std::size_t n = 0; n < values.size(); ++n)
      in_range(values[n], parameters[n]);
    if (node.robot != S::Delay)
      host_.perform(node.robot, values, {});
  }

  static void in_range(std::int32_t value, const spec::Parameter& parameter) {
    if (value < parameter.least || value > parameter.greatest)
      throw Error::BadNumericParameter;
  }

  const Program& program_;
  const Names& names_;
  vm::NotebookHost& host_;
  std::uint64_t seeds_;
  std::uint64_t random_ = 0;
  std::vector<std::int32_t> values_; ///< of each symbol
  std::array<std::int32_t, 25> elements_{};
  std::vector<std::int32_t> data_;
  std::size_t data_next_ = 0;
  std::int32_t result_ = 0;
  std::uint32_t target_ = none; ///< of the `goto` that is being followed
  bool seconds_ = false;
  std::uint64_t most_ = 0;
};

} // namespace orb::structured
