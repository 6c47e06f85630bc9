#include "structured/lower.h"

#include "spec/limits.h"
#include "structured/blocks.h"
#include "structured/words.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace {

using spec::Operator;

constexpr std::size_t most_lines = 60000; ///< far beyond what any area holds
constexpr std::uint16_t largest_term = 64;
constexpr int deepest_inline = 64;

/// Where a jump is taken: where the condition holds, or where it does not.
enum class When : std::uint8_t { Holds, Fails };

When other(When when) {
  return when == When::Holds ? When::Fails : When::Holds;
}

/// Whether `sleep` is being read, whose durations are in seconds.
enum class Unit : std::uint8_t { Milliseconds, Seconds };

class Lowering {
public:
  Lowering(const Program& program, const Names& names, const Plan& plan)
      : program_(program), names_(names), plan_(plan), variable_of_(names.symbols.size(), none),
        result_of_(names.routines.size(), none) {
    code_.routines.assign(names.routines.size(), none);
  }

  Code run() {
    frames_.emplace_back();
    const auto& main = program_.files.front();
    block(main.statements_begin, main.statements_end);
    emit(LineKind::Do).robot = spec::Statement::End;
    // Routines that are called are written after the main program; they may call others.
    for (std::size_t n = 0; n < called_.size() && !full(); ++n)
      routine(called_[n]);
    code_.too_large = full();
    return std::move(code_);
  }

private:
  /// A routine that is being written: in a place of its own, or into its caller.
  struct Frame {
    std::uint32_t routine = 0;
    std::uint32_t return_label = none;                           ///< none: a `return` of the robot
    std::vector<std::pair<std::uint32_t, std::uint32_t>> labels; ///< names and their labels
    std::size_t loops = 0; ///< how many were open when it began
  };
  struct Loop {
    std::uint32_t exit;
    std::uint32_t again;
  };

  bool full() const { return code_.lines.size() > most_lines; }
  const Statement& at(std::uint32_t i) const { return program_.statements[i]; }
  const Item& item(const Statement& statement, std::uint32_t n) const {
    return program_.items[statement.items_begin + n];
  }
  static std::uint32_t size(const Statement& statement) {
    return statement.items_end - statement.items_begin;
  }

  // ---- lines

  CodeLine& emit(LineKind kind) {
    auto& line = code_.lines.emplace_back();
    line.kind = kind;
    line.origin = origin_;
    line.routine = static_cast<std::uint16_t>(std::min<std::uint32_t>(written_, 0xFFFF));
    return line;
  }
  std::uint32_t new_label() { return code_.labels++; }
  void label(std::uint32_t label) { emit(LineKind::Label).label = label; }
  void go(std::uint32_t label) { emit(LineKind::Goto).label = label; }
  void let(std::uint32_t variable, std::uint32_t term) {
    auto& line = emit(LineKind::Let);
    line.variable = variable;
    line.term = term;
  }
  std::uint32_t into_temporary(std::uint32_t term) {
    const auto variable = code_.new_variable();
    let(variable, term);
    return variable;
  }
  /// A term that stays what it is now.
  std::uint32_t kept(std::uint32_t term) {
    return code_.is_number(term) ? term : code_.read(into_temporary(term));
  }
  void go_if(Comparison comparison, std::uint32_t left, std::uint32_t right, std::uint32_t label) {
    Condition condition;
    condition.first = {comparison, left, right, {}, {}};
    code_.conditions.push_back(condition);
    auto& line = emit(LineKind::If);
    line.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
    line.label = label;
  }

  std::uint32_t variable_of(std::uint32_t symbol) {
    auto& variable = variable_of_[symbol];
    if (variable == none) {
      variable = code_.new_variable();
      code_.variables[variable].symbol = symbol;
    }
    return variable;
  }

  // ---- values: a stack of terms that are read but not computed yet

  void push(std::uint32_t term) { pending_.push_back(term); }
  std::uint32_t pop() {
    const auto term = pending_.back();
    pending_.pop_back();
    return term;
  }

  /// Computes what lies on the stack and must happen before something with these effects, and what
  /// must happen before that.
  void settle(std::uint8_t effects) {
    std::vector<std::size_t> early;
    for (auto i = pending_.size(); i-- > 0;)
      if (const auto own = code_.terms[pending_[i]].effects; ordered(own, effects)) {
        effects |= own;
        early.push_back(i);
      }
    for (auto i = early.rbegin(); i != early.rend(); ++i)
      pending_[*i] = code_.read(into_temporary(pending_[*i]));
  }

  /// Computes all that a call could change, up to `end`.
  void settle_calls(std::size_t end) {
    for (std::size_t i = 0; i < end; ++i) {
      const auto& term = code_.terms[pending_[i]];
      const bool temporary = term.kind == TermKind::Variable && term.left != index_variable &&
                             code_.variables[term.left].symbol == none && !is_result(term.left);
      if (term.kind != TermKind::Number && !temporary)
        pending_[i] = code_.read(into_temporary(pending_[i]));
    }
  }
  bool is_result(std::uint32_t variable) const {
    return std::find(result_of_.begin(), result_of_.end(), variable) != result_of_.end();
  }

  std::uint32_t spill(std::uint32_t term) {
    settle(code_.terms[term].effects);
    return code_.read(into_temporary(term));
  }

  std::uint32_t binary(Operator op, std::uint32_t left, std::uint32_t right) {
    const auto most = spec::value_of(spec::Limit::ExpressionLevels);
    while (levels_of(code_, op, left, right) > most ||
           code_.terms[left].size + code_.terms[right].size > largest_term) {
      const auto& a = code_.terms[left];
      const auto& b = code_.terms[right];
      const bool right_is_worse = b.levels > a.levels || (b.levels == a.levels && b.size >= a.size);
      if (right_is_worse && !code_.is_leaf(right)) {
        if (ordered(a.effects, b.effects))
          left = spill(left);
        right = spill(right);
      } else {
        left = spill(left);
      }
    }
    return code_.binary(op, left, right);
  }

  std::uint32_t call(spec::Function function, std::uint32_t operand) {
    const auto most = spec::value_of(spec::Limit::ExpressionLevels);
    const auto term = code_.call(function, operand);
    if (code_.terms[term].levels <= most)
      return term;
    return code_.call(function, spill(operand));
  }

  /// Reads an expression; its value lies on the stack afterwards.
  void push_value(std::uint32_t root, Unit unit = Unit::Milliseconds) {
    for (auto n = program_.nodes[root].first; n <= root; ++n)
      push_node(n, unit);
  }

  std::uint32_t value(std::uint32_t root, Unit unit = Unit::Milliseconds) {
    push_value(root, unit);
    return pop();
  }

  void push_node(std::uint32_t n, Unit unit) {
    const auto& node = program_.nodes[n];
    switch (node.kind) {
    case NodeKind::Number: push(code_.number(node.value)); return;
    case NodeKind::Duration:
      push(code_.number(unit == Unit::Seconds ? node.value / 1000 : node.value));
      return;
    case NodeKind::Name: push(name(names_.of_node[n])); return;
    case NodeKind::System: push(code_.system(static_cast<spec::Variable>(node.what))); return;
    case NodeKind::Element: {
      const auto index = pop();
      point_at(names_.of_node[n], index);
      settle(effect::faults);
      push(code_.read(into_temporary(code_.element())));
      return;
    }
    case NodeKind::Call: push_call(n); return;
    case NodeKind::Builtin: push(call(static_cast<spec::Function>(node.what), pop())); return;
    case NodeKind::Least: push_choice(Comparison::LessEqual); return;
    case NodeKind::Greatest: push_choice(Comparison::GreaterEqual); return;
    case NodeKind::Negate: {
      const auto operand = pop();
      push(binary(Operator::Subtract, code_.number(0), operand));
      return;
    }
    case NodeKind::Binary: {
      const auto right = pop();
      const auto left = pop();
      push(binary(static_cast<Operator>(node.what), left, right));
      return;
    }
    case NodeKind::Relation:
    case NodeKind::Not:
    case NodeKind::And:
    case NodeKind::Or: push(code_.number(0)); return; // reported: a condition is not a value
    }
  }

  std::uint32_t name(std::uint32_t symbol) {
    if (symbol == none)
      return code_.number(0);
    if (names_.symbols[symbol].kind == SymbolKind::Constant)
      return code_.number(names_.symbols[symbol].value);
    return code_.read(variable_of(symbol));
  }

  /// min and max: the first operand stays where `keeps` holds between it and the second.
  void push_choice(Comparison keeps) {
    const auto second = pop();
    const auto first = pop();
    settle(static_cast<std::uint8_t>(code_.terms[first].effects | code_.terms[second].effects));
    const auto result = into_temporary(first);
    const auto compared = code_.is_leaf(second) ? second : code_.read(into_temporary(second));
    const auto done = new_label();
    go_if(keeps, code_.read(result), compared, done);
    let(result, compared);
    label(done);
    push(code_.read(result));
  }

  /// Sets the index to an element of an array and makes sure that it is one of it: a wrong index
  /// becomes 0, at which the robot stops.
  void point_at(std::uint32_t array, std::uint32_t index) {
    if (array == none)
      return;
    const auto& symbol = names_.symbols[array];
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    settle(code_.terms[index].effects);
    const auto element = binary(Operator::Add, index, code_.number(symbol.base));
    const bool known = code_.is_number(element);
    let(index_variable, element);
    if (known)
      return; // a wrong one has been reported
    const auto first = symbol.base + 1;
    const auto last = symbol.base + symbol.value;
    const auto good = new_label();
    const auto bad = new_label();
    const auto test = [&](Comparison comparison, std::int32_t bound, std::uint32_t target) {
      go_if(comparison, code_.read(index_variable), code_.number(bound), target);
      code_.lines.back().guard = true;
    };
    if (first > 1 && last < most) {
      test(Comparison::Less, first, bad);
      test(Comparison::LessEqual, last, good);
    } else if (first > 1) {
      test(Comparison::GreaterEqual, first, good);
    } else if (last < most) {
      test(Comparison::LessEqual, last, good);
    } else {
      return; // the robot's own limits
    }
    label(bad);
    let(index_variable, code_.number(0));
    code_.lines.back().guard = true;
    label(good);
  }

  // ---- calls

  void push_call(std::uint32_t n) {
    const auto symbol = names_.of_node[n];
    if (symbol == none) {
      pending_.resize(pending_.size() - program_.nodes[n].count);
      push(code_.number(0));
      return;
    }
    const auto routine = names_.symbols[symbol].routine;
    call_routine(routine, program_.nodes[n].count);
    push(code_.read(result(routine)));
  }

  std::uint32_t result(std::uint32_t routine) {
    auto& variable = result_of_[routine];
    if (variable == none)
      variable = code_.new_variable();
    return variable;
  }

  /// Calls a routine with the topmost values of the stack.
  void call_routine(std::uint32_t routine, std::size_t count) {
    const auto below = pending_.size() - count;
    settle_calls(below);
    const auto& callee = names_.routines[routine];
    for (std::size_t n = 0; n < count; ++n)
      let(variable_of(callee.first_parameter + static_cast<std::uint32_t>(n)), pending_[below + n]);
    pending_.resize(below);
    if (plan_.inlined[routine] && frames_.size() < deepest_inline && !full()) {
      const auto end = new_label();
      frames_.push_back({routine, end, {}, loops_.size()});
      body(routine);
      frames_.pop_back();
      label(end);
      return;
    }
    if (code_.routines[routine] == none) {
      code_.routines[routine] = new_label();
      called_.push_back(routine);
    }
    auto& line = emit(LineKind::Gosub);
    line.label = code_.routines[routine];
    line.variable = routine;
  }

  void routine(std::uint32_t routine) {
    written_ = routine;
    origin_ = names_.routines[routine].statement;
    label(code_.routines[routine]);
    frames_.assign(1, {routine, none, {}, 0});
    body(routine);
    emit(LineKind::Return);
  }

  void body(std::uint32_t routine) {
    const auto& callee = names_.routines[routine];
    const auto saved = origin_;
    origin_ = callee.statement;
    for (const auto local : callee.locals)
      let(variable_of(local), code_.number(0));
    const auto end = at(callee.statement).next;
    block(callee.statement + 1, end);
    const auto& symbol = names_.symbols[callee.symbol];
    if (symbol.kind == SymbolKind::Function) {
      origin_ = end;
      let(result(routine), code_.number(0));
    }
    origin_ = saved;
  }

  // ---- statements

  void block(std::uint32_t from, std::uint32_t to) {
    for (auto i = from; i < to && !full();)
      i = statement(i);
  }

  /// Writes a statement, a block with all that is in it; returns the next one.
  std::uint32_t statement(std::uint32_t i) {
    const auto& node = at(i);
    origin_ = i;
    switch (node.kind) {
    case Kind::Robot: robot(node); break;
    case Kind::Assign: assign(node); break;
    case Kind::Print: print(node); break;
    case Kind::Call: call_statement(i, node); break;
    case Kind::Return: leave(node); break;
    case Kind::Exit:
      if (!loops_.empty())
        go(loops_.back().exit);
      break;
    case Kind::Continue:
      if (!loops_.empty())
        go(loops_.back().again);
      break;
    case Kind::Label: label(user_label(node.name)); break;
    case Kind::Goto: go(user_label(node.name)); break;
    case Kind::If: return conditional(i);
    case Kind::While: return while_loop(i);
    case Kind::Repeat: return repeat_until(i);
    case Kind::RepeatTimes: return repeat_times(i);
    case Kind::Loop: return endless(i);
    case Kind::For: return counting(i);
    case Kind::Select: return selection(i);
    case Kind::Sub:
    case Kind::Function: return node.next == none ? i + 1 : node.next + 1;
    case Kind::Const:
    case Kind::Local:
    case Kind::Array:
    case Kind::Use:
    case Kind::Include:
    case Kind::ElseIf:
    case Kind::Else:
    case Kind::EndIf:
    case Kind::EndWhile:
    case Kind::Until:
    case Kind::EndRepeat:
    case Kind::EndLoop:
    case Kind::Next:
    case Kind::Case:
    case Kind::EndSelect:
    case Kind::EndSub:
    case Kind::EndFunction:
    case Kind::Broken: break;
    }
    return i + 1;
  }

  std::uint32_t user_label(std::uint32_t name) {
    for (const auto& [other, label] : frames_.back().labels)
      if (other == name)
        return label;
    frames_.back().labels.push_back({name, new_label()});
    return frames_.back().labels.back().second;
  }

  void call_statement(std::uint32_t i, const Statement& node) {
    if (names_.of_statement[i] == none)
      return;
    for (std::uint32_t n = 0; n < size(node); ++n)
      push_value(item(node, n).value);
    call_routine(names_.symbols[names_.of_statement[i]].routine, size(node));
  }

  void leave(const Statement& node) {
    const auto frame = frames_.back();
    if (size(node) > 0)
      let(result(frame.routine), value(item(node, 0).value));
    if (frame.return_label == none)
      emit(LineKind::Return);
    else
      go(frame.return_label);
  }

  void assign(const Statement& node) {
    const auto& target = item(node, 0);
    const auto& place = program_.nodes[target.value];
    const bool compound = node.operation != Statement::none_operation;
    const auto root = item(node, 1).value;
    if (place.kind == NodeKind::Element) {
      assign_element(node, target.value, root);
      return;
    }
    const bool system = place.kind == NodeKind::System;
    if (compound)
      push(system ? code_.system(static_cast<spec::Variable>(place.what))
                  : name(names_.of_node[target.value]));
    push_value(root);
    auto term = pop();
    if (compound)
      term = binary(static_cast<Operator>(node.operation), pop(), term);
    if (system) {
      auto& line = emit(LineKind::SetSystem);
      line.variable = place.what;
      line.term = term;
    } else if (names_.of_node[target.value] != none) {
      let(variable_of(names_.of_node[target.value]), term);
    }
  }

  void assign_element(const Statement& node, std::uint32_t place, std::uint32_t root) {
    const auto array = names_.of_node[place];
    push_value(place - 1);
    if (node.operation == Statement::none_operation) {
      push_value(root);
      const auto term = pop();
      const auto index = pop();
      pending_.push_back(term); // computed after the index
      auto below = std::exchange(pending_, {});
      point_at(array, index);
      pending_ = std::move(below);
      emit(LineKind::SetElement).term = pop();
      return;
    }
    auto index = pop();
    if (!code_.is_number(index))
      index = spill(index);
    point_at(array, index);
    push(code_.read(into_temporary(code_.element())));
    push_value(root);
    const auto right = pop();
    const auto left = pop();
    const auto term = binary(static_cast<Operator>(node.operation), left, right);
    if (array != none)
      let(index_variable,
          code_.binary(Operator::Add, index, code_.number(names_.symbols[array].base)));
    emit(LineKind::SetElement).term = term;
  }

  void add_part(PartKind kind, std::uint32_t value, Span text = {}) {
    code_.parts.push_back({kind, value, text, {}});
  }
  std::uint32_t parts_now() const { return static_cast<std::uint32_t>(code_.parts.size()); }

  void print(const Statement& node) {
    const auto base = pending_.size();
    for (const auto& part : program_.items_of(node))
      if (part.kind == ItemKind::Expression || part.kind == ItemKind::Character)
        push_value(part.value);
    const auto begin = parts_now();
    auto next = base;
    for (std::uint32_t n = 0; n < size(node); ++n) {
      const auto& part = item(node, n);
      if (part.kind == ItemKind::Expression)
        add_part(PartKind::Term, pending_[next++]);
      else if (part.kind == ItemKind::Character)
        add_part(PartKind::Character, pending_[next++]);
      else if (part.kind == ItemKind::String)
        add_part(PartKind::Text, none, {part.span.begin + 1, part.span.end - 1});
      else if (part.kind == ItemKind::Comma)
        add_part(PartKind::Blank, none);
      else if (n + 1 == size(node))
        add_part(PartKind::Open, none);
    }
    pending_.resize(base);
    finish(emit(LineKind::Print), begin);
  }

  void finish(CodeLine& line, std::uint32_t begin) {
    line.parts_begin = begin;
    line.parts_end = parts_now();
  }

  void perform(spec::Statement robot, std::uint32_t begin) {
    auto& line = emit(LineKind::Do);
    line.robot = robot;
    finish(line, begin);
  }

  void robot(const Statement& node) {
    if (node.robot == spec::Statement::Read)
      return read(node);
    if (node.robot == spec::Statement::Input)
      return input(node);
    if (node.robot == spec::Statement::Sleep)
      return sleep(node);
    if (node.robot == spec::Statement::Rgb && size(node) == 1)
      return colour(node);
    const auto base = pending_.size();
    for (const auto& part : program_.items_of(node))
      push_value(part.value);
    const auto begin = parts_now();
    for (auto n = base; n < pending_.size(); ++n)
      add_part(PartKind::Term, pending_[n]);
    pending_.resize(base);
    perform(node.robot, begin);
  }

  void colour(const Statement& node) {
    const auto& part = item(node, 0);
    const auto named = find_colour(program_.text_of(part.span));
    const auto colour = part.kind == ItemKind::Colour ? part.value : named.value_or(0);
    const auto begin = parts_now();
    for (const int shift : {16, 8, 0})
      add_part(PartKind::Term, code_.number(static_cast<std::int32_t>(colour >> shift & 0xFF)));
    perform(spec::Statement::Rgb, begin);
  }

  void sleep(const Statement& node) {
    push_value(item(node, 0).value, Unit::Seconds);
    if (size(node) > 1)
      push_value(item(node, 1).value);
    else
      push(code_.number(0));
    const auto begin = parts_now();
    const auto macro = pop();
    add_part(PartKind::Term, pop());
    add_part(PartKind::Term, macro);
    if (size(node) > 2)
      add_part(PartKind::Restart, none);
    else
      add_part(PartKind::Term, code_.number(0));
    perform(spec::Statement::Sleep, begin);
  }

  void read(const Statement& node) {
    auto begin = parts_now();
    const auto flush = [&] {
      if (parts_now() > begin)
        perform(spec::Statement::Read, begin);
      begin = parts_now();
    };
    for (const auto& part : program_.items_of(node)) {
      if (program_.nodes[part.value].kind == NodeKind::Element) {
        flush();
        const auto index = value(part.value - 1);
        point_at(names_.of_node[part.value], index);
        begin = parts_now();
        add_part(PartKind::Element, none);
        flush();
      } else {
        add_target(part.value);
      }
    }
    flush();
  }

  void add_target(std::uint32_t place) {
    if (names_.of_node[place] != none)
      add_part(PartKind::Variable, variable_of(names_.of_node[place]));
  }

  void input(const Statement& node) {
    const auto place = item(node, 0).value;
    const bool element = program_.nodes[place].kind == NodeKind::Element;
    if (element)
      push_value(place - 1);
    for (std::uint32_t n = 1; n < size(node); ++n)
      push_value(item(node, n).value);
    std::vector<std::uint32_t> terms(pending_.end() - (size(node) - 1), pending_.end());
    pending_.resize(pending_.size() - terms.size());
    if (element) {
      const auto index = pop();
      auto below = std::exchange(pending_, {});
      point_at(names_.of_node[place], index);
      pending_ = std::move(below);
    }
    const auto begin = parts_now();
    if (element)
      add_part(PartKind::Element, none);
    else
      add_target(place);
    for (const auto term : terms)
      add_part(PartKind::Term, term);
    perform(spec::Statement::Input, begin);
  }

  // ---- conditions

  /// Jumps to `label` where the condition holds, or where it fails; goes on below otherwise.
  void branch(std::uint32_t root, When when, std::uint32_t label) {
    const auto& node = program_.nodes[root];
    if (node.kind == NodeKind::Not) {
      branch(root - 1, other(when), label);
    } else if (node.kind == NodeKind::And || node.kind == NodeKind::Or) {
      branch_chain(root, when, label);
    } else if (node.kind == NodeKind::Relation) {
      push_value(program_.before(root - 1));
      push_value(root - 1);
      const auto right = pop();
      const auto left = pop();
      compare(static_cast<Comparison>(node.what), left, right, when, label);
    } else {
      compare(Comparison::NotEqual, value(root), code_.number(0), when, label);
    }
  }

  void compare(Comparison comparison, std::uint32_t left, std::uint32_t right, When when,
               std::uint32_t label) {
    if (when == When::Fails)
      comparison = opposite(comparison);
    if (code_.is_number(left) && !code_.is_number(right)) {
      std::swap(left, right);
      comparison = mirrored(comparison);
    }
    go_if(comparison, left, right, label);
  }

  /// Operands joined by the same word, from left to right and no further than needed.
  void branch_chain(std::uint32_t root, When when, std::uint32_t label) {
    const auto kind = program_.nodes[root].kind;
    std::vector<std::uint32_t> operands;
    auto at = root;
    for (; program_.nodes[at].kind == kind; at = program_.before(at - 1))
      operands.push_back(at - 1);
    operands.push_back(at);
    std::reverse(operands.begin(), operands.end());
    const bool each_decides = (kind == NodeKind::Or) == (when == When::Holds);
    if (each_decides) {
      for (const auto operand : operands)
        branch(operand, when, label);
      return;
    }
    const auto skip = new_label();
    for (std::size_t n = 0; n + 1 < operands.size(); ++n)
      branch(operands[n], other(when), skip);
    branch(operands.back(), when, label);
    this->label(skip);
  }

  // ---- blocks

  std::uint32_t conditional(std::uint32_t i) {
    const auto end = new_label();
    auto part = i;
    while (at(part).kind != Kind::EndIf) {
      const auto next = at(part).next;
      origin_ = part;
      if (at(part).kind == Kind::Else) {
        block(part + 1, next);
      } else {
        const auto skip = new_label();
        branch(item(at(part), 0).value, When::Fails, skip);
        block(part + 1, next);
        if (at(next).kind != Kind::EndIf)
          go(end);
        label(skip);
      }
      part = next;
    }
    label(end);
    return part + 1;
  }

  template <typename Body>
  void in_loop(std::uint32_t exit, std::uint32_t again, Body write) {
    loops_.push_back({exit, again});
    write();
    loops_.pop_back();
  }

  std::uint32_t while_loop(std::uint32_t i) {
    const auto end = at(i).next;
    const auto top = new_label();
    const auto test = new_label();
    const auto exit = new_label();
    go(test);
    label(top);
    in_loop(exit, test, [&] { block(i + 1, end); });
    origin_ = i;
    label(test);
    branch(item(at(i), 0).value, When::Holds, top);
    label(exit);
    return end + 1;
  }

  std::uint32_t repeat_until(std::uint32_t i) {
    const auto end = at(i).next;
    const auto top = new_label();
    const auto test = new_label();
    const auto exit = new_label();
    label(top);
    in_loop(exit, test, [&] { block(i + 1, end); });
    origin_ = end;
    label(test);
    branch(item(at(end), 0).value, When::Fails, top);
    label(exit);
    return end + 1;
  }

  std::uint32_t endless(std::uint32_t i) {
    const auto end = at(i).next;
    const auto top = new_label();
    const auto exit = new_label();
    label(top);
    in_loop(exit, top, [&] { block(i + 1, end); });
    origin_ = end;
    go(top);
    label(exit);
    return end + 1;
  }

  std::uint32_t repeat_times(std::uint32_t i) {
    const auto end = at(i).next;
    const auto times = value(item(at(i), 0).value);
    const auto counter = code_.new_variable();
    const auto exit = new_label();
    const auto again = new_label();
    if (plan_.native[i]) {
      const auto last = kept(times);
      let(counter, code_.number(1));
      native(i, end, counter, last, 1, exit, again);
      return end + 1;
    }
    const auto top = new_label();
    const auto test = new_label();
    let(counter, times);
    go(test);
    label(top);
    in_loop(exit, again, [&] { block(i + 1, end); });
    origin_ = end;
    label(again);
    let(counter, code_.binary(Operator::Subtract, code_.read(counter), code_.number(1)));
    label(test);
    go_if(Comparison::Greater, code_.read(counter), code_.number(0), top);
    label(exit);
    return end + 1;
  }

  std::uint32_t counting(std::uint32_t i) {
    const auto& node = at(i);
    const auto end = node.next;
    const auto symbol = names_.of_node[item(node, 0).value];
    const auto counter = symbol == none ? code_.new_variable() : variable_of(symbol);
    const auto step = size(node) > 3 ? evaluate(program_, names_, item(node, 3).value)->value : 1;
    let(counter, value(item(node, 1).value));
    const auto last = kept(value(item(node, 2).value));
    const auto exit = new_label();
    const auto again = new_label();
    if (plan_.native[i]) {
      native(i, end, counter, last, step, exit, again);
      return end + 1;
    }
    const auto top = new_label();
    const auto test = new_label();
    go(test);
    label(top);
    in_loop(exit, again, [&] { block(i + 1, end); });
    origin_ = end;
    label(again);
    let(counter, code_.binary(Operator::Add, code_.read(counter), code_.number(step)));
    label(test);
    go_if(step > 0 ? Comparison::LessEqual : Comparison::GreaterEqual, code_.read(counter), last,
          top);
    label(exit);
    return end + 1;
  }

  /// The robot's own loop, whose body runs once before its end is looked at.
  void native(std::uint32_t i, std::uint32_t end, std::uint32_t counter, std::uint32_t last,
              std::int32_t step, std::uint32_t exit, std::uint32_t again) {
    go_if(step > 0 ? Comparison::Greater : Comparison::Less, code_.read(counter), last, exit);
    auto& line = emit(LineKind::For);
    line.variable = counter;
    line.term = code_.read(counter);
    line.end = last;
    line.step = step;
    const auto top = new_label();
    line.label = top;
    label(top);
    in_loop(exit, again, [&] { block(i + 1, end); });
    origin_ = end;
    label(again);
    auto& next = emit(LineKind::Next);
    next.variable = counter;
    next.label = top;
    next.step = step;
    label(exit);
  }

  std::uint32_t selection(std::uint32_t i) {
    const auto chosen = into_temporary(value(item(at(i), 0).value));
    const auto exit = new_label();
    auto otherwise = exit;
    std::vector<Case> cases;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> bodies; // part and label
    auto part = at(i).next;
    for (; at(part).kind != Kind::EndSelect; part = at(part).next) {
      const auto body = new_label();
      bodies.push_back({part, body});
      if (at(part).kind == Kind::Else)
        otherwise = body;
      else
        add_cases(at(part), body, cases);
    }
    auto& line = emit(LineKind::Switch);
    line.variable = chosen;
    line.label = otherwise;
    line.parts_begin = static_cast<std::uint32_t>(code_.cases.size());
    code_.cases.insert(code_.cases.end(), cases.begin(), cases.end());
    line.parts_end = static_cast<std::uint32_t>(code_.cases.size());
    for (const auto& [body, start] : bodies) {
      origin_ = body;
      label(start);
      block(body + 1, at(body).next);
      go(exit);
    }
    label(exit);
    return part + 1;
  }

  void add_cases(const Statement& node, std::uint32_t body, std::vector<Case>& cases) const {
    const auto number = [&](std::uint32_t n) {
      return evaluate(program_, names_, item(node, n).value)->value;
    };
    for (std::uint32_t n = 0; n < size(node); ++n) {
      const bool range = n + 2 < size(node) && item(node, n + 1).kind == ItemKind::To;
      cases.push_back({number(n), number(range ? n + 2 : n), body});
      n += range ? 2 : 0;
    }
  }

  const Program& program_;
  const Names& names_;
  const Plan& plan_;
  Code code_;
  std::vector<std::uint32_t> variable_of_; ///< of each symbol
  std::vector<std::uint32_t> result_of_;   ///< of each routine
  std::vector<std::uint32_t> called_;      ///< routines that get a place of their own
  std::vector<std::uint32_t> pending_;
  std::vector<Frame> frames_;
  std::vector<Loop> loops_;
  std::uint32_t origin_ = 0;
  std::uint32_t written_ = 0; ///< the routine whose place is being filled
};

} // namespace

Code lower(const Program& program, const Names& names, const Plan& plan) {
  return Lowering(program, names, plan).run();
}

} // namespace orb::structured
