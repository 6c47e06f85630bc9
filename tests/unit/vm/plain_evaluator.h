#pragma once

#include "basic_run.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/program.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace orb::vm {

/// A second orbBasic, as simple as possible: walks the tree of the text line by line and keeps only
/// what the language requires. Deliberately slow; the machine must agree with it.
class PlainEvaluator {
public:
  PlainEvaluator(std::string_view text, NotebookHost& host, std::int64_t lines_per_second,
                 std::uint64_t seed)
      : program_(compiler::parse(text)), host_(host), rate_(lines_per_second), seeds_(mix(seed)) {
    clear();
    line_ = first_ = following(0);
  }

  /// Continues for this many lines, or until the program ends.
  void run(std::uint64_t most_lines) {
    while (end.empty() && lines < most_lines) {
      if (line_ >= program_.lines.size()) {
        end = "end";
        return;
      }
      if (tron_)
        host_.print("<" + std::to_string(program_.lines[line_].number) + ">", now());
      ++lines;
      next_ = following(line_ + 1);
      try {
        execute(program_.statements[program_.lines[line_].statement]);
      } catch (BasicError error) {
        end = "Line " + std::to_string(program_.lines[line_].number) + ": " +
              std::string(spec::info(error).text);
        return;
      }
      line_ = next_;
    }
  }

  std::int32_t letter(std::size_t index) const { return letters_[index]; }
  std::int32_t element(std::size_t index) const { return elements_[index]; }
  Instant now() const {
    return Instant{} + waited_ + Duration{static_cast<std::int64_t>(lines) * 1'000'000'000 / rate_};
  }

  std::string end; ///< empty while it runs
  std::uint64_t lines = 0;

private:
  using BasicError = spec::BasicError;
  using Items = std::span<const compiler::Item>;
  struct Loop {
    int variable; ///< -1: Z
    std::int32_t end;
    std::int32_t step;
    std::size_t body;
  };

  static std::int32_t wrap(std::int64_t value) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value)));
  }
  static std::uint64_t mix(std::uint64_t value) {
    value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9u;
    value = (value ^ value >> 27) * 0x94D049BB133111EBu;
    return value ^ value >> 31;
  }

  std::size_t following(std::size_t line) const {
    while (line < program_.lines.size() && !program_.lines[line].has_statement())
      ++line;
    return line;
  }
  std::size_t find(std::uint32_t number) const {
    for (std::size_t i = 0; i < program_.lines.size(); ++i)
      if (program_.lines[i].number == number)
        return following(i);
    throw BasicError::BadLineNumber;
  }
  void reseed() {
    seeds_ += 0x9E3779B97F4A7C15u;
    random_ = mix(seeds_);
  }
  void clear() {
    letters_.fill(0);
    elements_.fill(0);
    loops_.clear();
    calls_.clear();
    data_.clear();
    data_next_ = 0;
    tron_ = false;
    since_.fill(now());
    from_.fill(0);
    reseed();
  }
  std::int32_t& z() {
    const std::int32_t y = letters_[24];
    if (y < 1 || y > 25)
      throw BasicError::IllegalIndex;
    return elements_[static_cast<std::size_t>(y - 1)];
  }

  // Expressions: operands precede operators, so a stack evaluates them in text order. A level too
  // deep fails where it opens.
  std::int32_t value(std::uint32_t root) {
    const auto& nodes = program_.nodes;
    const std::uint32_t first = nodes[root].first;
    std::vector<std::int32_t> stack;
    for (std::uint32_t i = first; i <= root; ++i) {
      for (std::uint32_t outer = i; outer <= root; ++outer)
        if (nodes[outer].depth > 4 && nodes[outer].first == i)
          throw BasicError::ExpressionTooComplex;
      const auto& node = nodes[i];
      const auto top = [&]() -> std::int32_t& { return stack.back(); };
      switch (node.kind) {
      case compiler::NodeKind::Number: stack.push_back(node.value); break;
      case compiler::NodeKind::Letter: stack.push_back(letters_[node.what]); break;
      case compiler::NodeKind::Indexed: stack.push_back(z()); break;
      case compiler::NodeKind::System:
        stack.push_back(read(static_cast<spec::Variable>(node.what)));
        break;
      case compiler::NodeKind::Group: break;
      case compiler::NodeKind::Negate: top() = wrap(-std::int64_t{top()}); break;
      case compiler::NodeKind::Call:
        top() = call(static_cast<spec::Function>(node.what), top());
        break;
      case compiler::NodeKind::Binary: {
        const std::int32_t right = top();
        stack.pop_back();
        top() = combine(static_cast<spec::Operator>(node.what), top(), right);
        break;
      }
      }
    }
    return stack.back();
  }
  static std::int32_t combine(spec::Operator op, std::int32_t x, std::int32_t y) {
    const std::int64_t a = x;
    const std::int64_t b = y;
    switch (op) {
    case spec::Operator::Multiply: return wrap(a * b);
    case spec::Operator::Divide:
      if (b == 0)
        throw BasicError::DivideByZero;
      return wrap(a / b);
    case spec::Operator::Remainder:
      if (b == 0)
        throw BasicError::DivideByZero;
      return wrap(a % b);
    case spec::Operator::ShiftLeft:
      if (b < 0 || b > 31)
        throw BasicError::BadNumericParameter;
      return wrap(a * (std::int64_t{1} << b));
    case spec::Operator::ShiftRight:
      if (b < 0 || b > 31)
        throw BasicError::BadNumericParameter;
      return wrap(a >> b);
    case spec::Operator::Add: return wrap(a + b);
    case spec::Operator::Subtract: return wrap(a - b);
    case spec::Operator::And: return x & y;
    case spec::Operator::Or: return x | y;
    }
    return 0;
  }
  std::int32_t call(spec::Function function, std::int32_t x) {
    switch (function) {
    case spec::Function::Sqrt: {
      if (x < 0)
        throw BasicError::BadNumericParameter;
      std::int64_t root = 0;
      while ((root + 1) * (root + 1) <= x)
        ++root;
      return static_cast<std::int32_t>(root);
    }
    case spec::Function::Rnd: {
      if (x < 1)
        throw BasicError::BadNumericParameter;
      random_ += 0x9E3779B97F4A7C15u;
      return 1 +
             static_cast<std::int32_t>((mix(random_) >> 32) * static_cast<std::uint64_t>(x) >> 32);
    }
    case spec::Function::Abs: return x < 0 ? wrap(-std::int64_t{x}) : x;
    }
    return 0;
  }
  static std::optional<std::size_t> timer(spec::Variable variable) {
    if (variable == spec::Variable::TimerA)
      return 0;
    if (variable == spec::Variable::TimerB)
      return 1;
    if (variable == spec::Variable::TimerC)
      return 2;
    return std::nullopt;
  }
  std::int32_t read(spec::Variable variable) {
    const auto n = timer(variable);
    if (!n)
      return host_.read(variable, now());
    const auto elapsed = (now() - since_[*n]).count() / 1'000'000;
    return static_cast<std::int32_t>(
        from_[*n] == 0 ? elapsed % 65536 : std::max<std::int64_t>(from_[*n] - elapsed, 0));
  }

  void set(const compiler::Item& variable, std::int32_t to) {
    if (variable.kind == compiler::ItemKind::Letter) {
      letters_[variable.value] = to;
    } else if (variable.kind == compiler::ItemKind::Indexed) {
      z() = to;
    } else if (const auto n = timer(static_cast<spec::Variable>(variable.value))) {
      in_range(to, 0, 65535);
      since_[*n] = now();
      from_[*n] = to;
    } else {
      host_.write(static_cast<spec::Variable>(variable.value), to, now());
    }
  }
  static void in_range(std::int32_t x, std::int32_t least, std::int32_t greatest) {
    if (x < least || x > greatest)
      throw BasicError::BadNumericParameter;
  }
  bool relation(Items items, std::size_t at) {
    const std::int32_t x = value(items[at].value);
    const std::int32_t y = value(items[at + 2].value);
    switch (static_cast<spec::Relation>(items[at + 1].value)) {
    case spec::Relation::Equal: return x == y;
    case spec::Relation::NotEqual: return x != y;
    case spec::Relation::Less: return x < y;
    case spec::Relation::Greater: return x > y;
    }
    return false;
  }
  void gosub(std::size_t target) {
    if (calls_.size() == 4)
      throw BasicError::GosubDepthExceeded;
    calls_.push_back(following(line_ + 1));
    next_ = target;
  }

  void execute(const compiler::StatementNode& node) {
    using spec::Statement;
    if (node.error)
      throw *node.error;
    const auto items = program_.items_of(node);
    const auto variable = [&](const compiler::Item& item) {
      return item.kind == compiler::ItemKind::Indexed ? -1 : static_cast<int>(item.value);
    };
    switch (node.kind) {
    case Statement::Let: set(items[0], value(items[1].value)); return;
    case Statement::If: {
      bool holds = relation(items, 0);
      if (items.size() > 3) {
        const bool second = relation(items, 4);
        holds = items[3].kind == compiler::ItemKind::And ? holds && second : holds || second;
      }
      if (holds)
        execute(program_.statements[node.then_branch]);
      else if (node.else_branch != compiler::none)
        execute(program_.statements[node.else_branch]);
      return;
    }
    case Statement::For: {
      set(items[0], value(items[1].value));
      const std::int32_t last = value(items[2].value);
      const std::int32_t step = items.size() > 3 ? value(items[3].value) : 1;
      if (step == 0)
        throw BasicError::BadStepValue;
      const Loop loop{variable(items[0]), last, step, following(line_ + 1)};
      if (!loops_.empty() && loops_.back().variable == loop.variable)
        loops_.pop_back();
      if (loops_.size() == 4)
        throw BasicError::ForDepthExceeded;
      loops_.push_back(loop);
      next_ = loop.body;
      return;
    }
    case Statement::Next: {
      if (loops_.empty() || loops_.back().variable != variable(items[0]))
        throw BasicError::NextWithoutFor;
      const Loop loop = loops_.back();
      std::int32_t& counter =
          loop.variable < 0 ? z() : letters_[static_cast<std::size_t>(loop.variable)];
      counter = wrap(std::int64_t{counter} + loop.step);
      if (loop.step > 0 ? counter <= loop.end : counter >= loop.end)
        next_ = loop.body;
      else
        loops_.pop_back();
      return;
    }
    case Statement::Goto: next_ = find(items[0].value); return;
    case Statement::Gosub: gosub(find(items[0].value)); return;
    case Statement::Return:
      if (calls_.empty())
        throw BasicError::ReturnWithoutGosub;
      next_ = calls_.back();
      calls_.pop_back();
      return;
    case Statement::On: {
      const std::int32_t chosen = value(items[0].value);
      if (chosen < 1 || chosen >= static_cast<std::int64_t>(items.size()))
        throw BasicError::IllegalIndex;
      const auto target = find(items[static_cast<std::size_t>(chosen)].value);
      if (node.spelling == compiler::Spelling::OnGosub)
        gosub(target);
      else
        next_ = target;
      return;
    }
    case Statement::Print: print(items); return;
    case Statement::Input: {
      if (items.size() < 3) {
        end = "running";
        return;
      }
      const std::int32_t time = value(items[1].value);
      const std::int32_t fallback = value(items[2].value);
      in_range(time, 0, 65535);
      waited_ += std::chrono::milliseconds{time};
      set(items[0], fallback);
      return;
    }
    case Statement::Delay: {
      const std::int32_t time = value(items[0].value);
      in_range(time, 0, 65535);
      waited_ += std::chrono::milliseconds{time};
      return;
    }
    case Statement::End: end = "end"; return;
    case Statement::Data: {
      std::vector<std::int32_t> set;
      for (std::size_t i = 0; i < items.size() && i < 25; ++i)
        set.push_back(value(items[i].value));
      data_ = set;
      data_next_ = 0;
      return;
    }
    case Statement::Rstr: data_next_ = 0; return;
    case Statement::Read:
      for (const auto& item : items) {
        if (data_next_ == data_.size())
          throw BasicError::OutOfData;
        const std::int32_t taken = data_[data_next_++];
        set(item, taken);
      }
      return;
    case Statement::Random: reseed(); return;
    case Statement::Tron: tron_ = true; return;
    case Statement::Troff: tron_ = false; return;
    case Statement::Reset:
      clear();
      next_ = first_;
      host_.perform(Statement::Reset, {}, now());
      return;
    case Statement::Rgb:
    case Statement::Ledc:
    case Statement::BackLed:
    case Statement::Goroll:
    case Statement::Heading:
    case Statement::Raw:
    case Statement::Locate:
    case Statement::Basflg:
    case Statement::Sleep:
    case Statement::Macrun:
    case Statement::Mackill: {
      std::vector<std::int32_t> values;
      for (const auto& item : items)
        values.push_back(value(item.value));
      const auto parameters = spec::info(node.kind).parameters();
      for (std::size_t i = 0; i < values.size(); ++i)
        in_range(values[i], parameters[i].least, parameters[i].greatest);
      host_.perform(node.kind, values, now());
      return;
    }
    }
  }

  void print(Items items) {
    std::string text;
    for (const auto& item : items) {
      if (item.kind == compiler::ItemKind::String) {
        const auto quoted = program_.text_of(item.span);
        text += quoted.substr(1, quoted.size() - 2);
      } else if (item.kind == compiler::ItemKind::Expression) {
        text += std::to_string(value(item.value));
      } else if (item.kind == compiler::ItemKind::Character) {
        text += static_cast<char>(static_cast<unsigned char>(value(item.value)));
      } else if (item.kind == compiler::ItemKind::Comma) {
        text += ' ';
      }
    }
    const bool open = !items.empty() && items.back().kind == compiler::ItemKind::Semicolon;
    if (text.size() > 32)
      text = "(print exceeds 32 bytes)\n";
    else if (!open)
      text += '\n';
    host_.print(text, now());
  }

  compiler::Program program_;
  NotebookHost& host_;
  std::int64_t rate_;
  Duration waited_{};
  std::array<std::int32_t, 25> letters_{};
  std::array<std::int32_t, 25> elements_{};
  std::vector<Loop> loops_;
  std::vector<std::size_t> calls_;
  std::vector<std::int32_t> data_;
  std::size_t data_next_ = 0;
  std::array<Instant, 3> since_{};
  std::array<std::int32_t, 3> from_{};
  std::uint64_t seeds_;
  std::uint64_t random_ = 0;
  bool tron_ = false;
  std::size_t first_ = 0;
  std::size_t line_ = 0;
  std::size_t next_ = 0;
};

} // namespace orb::vm
