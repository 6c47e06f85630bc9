#include "compiler/analyse/trial_line.h"

#include "compiler/analyse/reading.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::compiler {
namespace {

Origin origin_of(const spec::VariableInfo& row) {
  return row.unit == "ms" || row.unit == "cm" || row.variable == spec::Variable::Speed
             ? Origin::Motion
             : Origin::World;
}

} // namespace

void TrialLine::stop(const Rule& rule, Span span, Message message, Message help) {
  if (quiet_ || stopped_)
    return;
  stopped_ = true;
  add({&rule, span, std::move(message), std::move(help), now_.decision, runs_[line_] > 1});
}

void TrialLine::warn(Span span, Message message, Message help) {
  if (!quiet_ && !stopped_)
    add({&rules::MayLeaveRange, span, std::move(message), std::move(help), now_.decision, true,
         false});
}

void TrialLine::add(TrialFault fault) {
  if (probing_)
    return;
  constexpr int most_decisions = 16; // of people and chance; more are no path that anyone takes
  auto before = fault.decision;
  for (int n = 0; n < most_decisions && before != none; ++n)
    before = trial_.decisions[before].before;
  if (before != none)
    return;
  const auto said = std::find_if(trial_.faults.begin(), trial_.faults.end(),
                                 [&](const TrialFault& one) { return one.span == fault.span; });
  if (said == trial_.faults.end())
    trial_.faults.push_back(std::move(fault));
  else if (fault.certain && !said->certain)
    *said = std::move(fault);
}

std::uint32_t TrialLine::round() const {
  const auto runs = runs_[line_];
  if (now_.decision != none || !now_.calls.empty() || runs < 2)
    return 0;
  const auto loop = only_loop();
  return loop != none && runs_[loop] == runs ? runs : 0;
}

std::uint32_t TrialLine::only_loop() const {
  if (now_.loops.size() > 1)
    return none;
  auto loop = now_.loops.empty() ? none : now_.loops.front().body;
  for (const auto& jump : flow_.jumps)
    if (!jump.call && jump.to <= line_ && line_ <= jump.from) {
      if (loop != none && loop != jump.to)
        return none;
      loop = jump.to;
    }
  return loop;
}

void TrialLine::stop_at(Span span, Message allowed, const Range& range, Message help) {
  const auto text = program_.text_of(span);
  stop(rules::MayLeaveRange, span,
       round() > 0 ? texts::ButBecomesInRound(std::move(allowed), text, shown(range), round())
                   : texts::ButBecomes(std::move(allowed), text, shown(range)),
       std::move(help));
}

const Value& TrialLine::value(const Item& item) {
  for (auto n = program_.nodes[item.value].first; n <= item.value; ++n)
    known_[n] = compute(program_.nodes[n], n);
  return known_[item.value];
}

Value TrialLine::compute(const Node& node, std::uint32_t index) {
  switch (node.kind) {
  case NodeKind::Letter: return now_.letters[node.what];
  case NodeKind::Indexed: return element(node.span);
  case NodeKind::System: {
    const auto& row = spec::variables[node.what];
    return {{row.least, row.greatest}, true, true, origin_of(row)};
  }
  case NodeKind::Call:
    check_operand(spec::functions[node.what], program_.nodes[index - 1].span, known_[index - 1]);
    break;
  case NodeKind::Binary:
    check_right(static_cast<spec::Operator>(node.what), program_.nodes[index - 1].span,
                known_[index - 1]);
    break;
  case NodeKind::Number:
  case NodeKind::Group:
  case NodeKind::Negate: break;
  }
  return value_of(program_, index, known_);
}

bool TrialLine::may_leave(const Value& value, std::int64_t least, std::int64_t greatest) {
  return value.exact && value.origin == Origin::Program &&
         (value.range.lo < least || value.range.hi > greatest);
}

void TrialLine::check_operand(const spec::FunctionInfo& row, Span span, const Value& operand) {
  if (operand.range.misses(row.least, row.greatest))
    stop_at(span, texts::TakesOrMore(row.word, row.least), operand.range);
  else if (may_leave(operand, row.least, row.greatest))
    warn(span, texts::ButCanBeOne(texts::TakesOrMore(row.word, row.least), program_.text_of(span),
                                  operand.range.lo));
}

void TrialLine::check_right(spec::Operator op, Span span, const Value& operand) {
  const auto& right = operand.range;
  const auto most = spec::value_of(spec::Limit::GreatestShift);
  const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
  const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
  const auto text = program_.text_of(span);
  if (divides && right == Range::only(0))
    stop(rules::MayLeaveRange, span,
         round() > 0 ? texts::DividesByZeroInRound(text, round()) : texts::DividesByZeroHere(text));
  else if (divides && right.has(0) && operand.origin == Origin::Program &&
           (operand.dense || (operand.exact && (right.lo == 0 || right.hi == 0))))
    warn(span, texts::DividesByZeroAtTimes(text));
  else if (shifts && right.misses(0, most))
    stop_at(span, texts::ShiftMustBe(most), right);
}

Value* TrialLine::selected(Span span) {
  auto& index = now_.letters[index_letter];
  const auto most = spec::value_of(spec::Limit::IndexedVariables);
  if (index.range.misses(1, most)) {
    stop(rules::MayLeaveRange, span,
         texts::UsedWhileIndexBecomes('Z', 'Y', shown(index.range), 1, most));
  } else if (may_leave(index, 1, most)) {
    warn(span, texts::UsedWhileIndexCanBe('Z', 'Y', shown(index.range), 1, most));
    index.exact = index.dense = false; // what follows only runs with the other values
  }
  return element_at_index();
}

Value* TrialLine::element_at_index() {
  const auto& index = now_.letters[index_letter].range;
  return index.constant() && !index.misses(1, spec::value_of(spec::Limit::IndexedVariables))
             ? &now_.elements[static_cast<std::size_t>(index.lo) - 1]
             : nullptr;
}

Value* TrialLine::variable_of(const Node& node) {
  return node.kind == NodeKind::Letter    ? &now_.letters[node.what]
         : node.kind == NodeKind::Indexed ? element_at_index()
                                          : nullptr;
}

Value TrialLine::element(Span span) {
  const auto* one = selected(span);
  return one == nullptr ? Value{} : *one;
}

void TrialLine::check_value(const Item& item, std::string_view word,
                            const spec::Parameter& parameter) {
  const auto& found = value(item);
  const auto& range = found.range;
  if (!range.misses(parameter.least, parameter.greatest)) {
    if (!may_leave(found, parameter.least, parameter.greatest))
      return;
    warn(item.span, texts::ButCanBeOne(allowed_values(word, parameter), program_.text_of(item.span),
                                       range.lo < parameter.least ? range.lo : range.hi));
    blur(item); // further lines only run with the other values
    return;
  }
  Message help;
  if (parameter.unit == "deg" && range.lo > 0)
    help = texts::WriteRemainder(in_parentheses(item), parameter.greatest + 1);
  stop_at(item.span, allowed_values(word, parameter), range, std::move(help));
}

std::string TrialLine::in_parentheses(const Item& item) const {
  const auto kind = program_.nodes[item.value].kind;
  const auto text = std::string(program_.text_of(item.span));
  return kind == NodeKind::Binary || kind == NodeKind::Negate || kind == NodeKind::Call
             ? fmt::format("({})", text)
             : text;
}

void TrialLine::set(const Item& variable, Value to) {
  to.fresh = false;
  if (variable.kind == ItemKind::Letter) {
    now_.letters[variable.value] = to;
  } else if (variable.kind == ItemKind::Indexed) {
    if (auto* one = selected(variable.span))
      *one = to;
    else
      for (auto& any : now_.elements)
        any = {join(any.range, to.range)};
  }
}

bool TrialLine::bind(const Item& expression) {
  bool any = false;
  each_variable(expression, [&](Value& one) {
    one.ties = Ties::Shared;
    any = true;
  });
  return any;
}

void TrialLine::obey(const StatementNode& statement) {
  const auto& row = spec::info(statement.kind);
  const auto items = program_.items_of(statement);
  if (row.form == spec::Form::Assignment)
    return let(program_.as<LetView>(statement));
  if (row.form == spec::Form::Variables)
    return read(statement);
  if (row.form == spec::Form::Entry)
    return input(program_.as<InputView>(statement));
  if (row.form == spec::Form::Values)
    now_.data = static_cast<std::uint32_t>(&statement - program_.statements.data());
  if (row.form == spec::Form::Values || statement.kind == spec::Statement::Rstr)
    now_.data_next = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (row.form == spec::Form::Arguments)
      check_value(items[i], row.word, row.parameter_slots[i]);
    else if (items[i].kind == ItemKind::Expression || items[i].kind == ItemKind::Character)
      value(items[i]);
}

void TrialLine::let(const LetView& let) {
  auto result = value(let.expression);
  if (let.variable.kind == ItemKind::System) {
    const auto& row = spec::variables[let.variable.value];
    if (row.variable != spec::Variable::Ctrl)
      check_value(let.expression, row.word, {"", row.least, row.greatest, row.unit});
    return;
  }
  result.ties = bind(let.expression) ? Ties::Depends : Ties::None;
  set(let.variable, result);
}

void TrialLine::read(const StatementNode& statement) {
  for (const auto& variable : program_.items_of(statement)) {
    Value next;
    if (now_.data == none) {
      stop(rules::ReadPastData, statement.span, texts::Without("read", "data"),
           texts::AddDataAbove());
    } else if (now_.data != Moment::unknown_data) {
      const auto all = program_.items_of(program_.statements[now_.data]);
      if (now_.data_next == all.size())
        return stop(rules::ReadPastData, statement.span,
                    counted(all.size(), texts::ValueIsRead, texts::ValuesAreRead),
                    texts::WriteRstr());
      const auto number = number_in(program_, all[now_.data_next++]);
      next = number ? Value::only(*number) : Value{};
    }
    set(variable, next);
  }
}

void TrialLine::input(const InputView& input) {
  const auto& row = spec::info(spec::Statement::Input);
  if (input.milliseconds != nullptr)
    check_value(*input.milliseconds, row.word, row.parameter_slots[0]);
  if (input.fallback != nullptr)
    value(*input.fallback);
  const bool asks = input.fallback == nullptr; // otherwise there may be nobody to answer
  set(input.variable, {{}, asks, asks, Origin::World});
}

} // namespace orb::compiler
