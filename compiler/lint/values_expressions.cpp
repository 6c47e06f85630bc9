#include "compiler/lint/values_pass.h"

namespace orb::compiler {
namespace {

/// By variable: among those that reading resets, the how manieth it is.
constexpr auto clearing_slots = [] {
  std::array<std::uint8_t, spec::variables.size()> slots{};
  std::uint8_t next = 0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    slots[i] = next;
    next = static_cast<std::uint8_t>(
        next + (spec::variables[i].access == spec::Access::ReadClears ? 1 : 0));
  }
  return slots;
}();

} // namespace

void ValuesPass::evaluate(const StatementNode& statement) {
  for (const auto& item : program_.items_of(statement)) {
    if (item.kind != ItemKind::Expression && item.kind != ItemKind::Character)
      continue;
    for (auto n = evaluated_; n <= item.value; ++n)
      evaluate(n);
    evaluated_ = item.value + 1;
    if (statement.kind == spec::Statement::For)
      begin_counting(program_.as<ForView>(statement), item);
  }
}

/// A loop has set its letter to its start when it computes its end.
void ValuesPass::begin_counting(const ForView& loop, const Item& computed) {
  if (&computed == &loop.start && loop.variable.kind == ItemKind::Letter)
    set_letter(loop.variable.value, range_of(computed));
}

void ValuesPass::evaluate(std::uint32_t index) {
  compute(index);
  const auto& node = program_.nodes[index];
  if (node.kind == NodeKind::Letter)
    note_use(node);
  else if (node.kind != NodeKind::Number)
    check_operation(node, index);
}

Range ValuesPass::compute(const Item& item) {
  if (!following_ && item.value < evaluated_)
    return ranges_[item.value];
  for (auto n = program_.nodes[item.value].first; n <= item.value; ++n)
    compute(n);
  return ranges_[item.value];
}

void ValuesPass::compute_operation(const Node& node, std::uint32_t index) {
  const auto right = index - 1; // or the only operand
  if (node.kind == NodeKind::Negate)
    return know(index, negate(ranges_[right]), exact_[right] != 0);
  if (node.kind == NodeKind::Call)
    return know(index, apply(spec::functions[node.what].function, ranges_[right]),
                exact_[right] != 0);
  const auto left = program_.nodes[right].first - 1;
  know(index, apply(static_cast<spec::Operator>(node.what), ranges_[left], ranges_[right]),
       is_exact_sum(node, right));
}

bool ValuesPass::is_exact_sum(const Node& node, std::uint32_t right) const {
  const auto left = program_.nodes[right].first - 1;
  if (exact_[left] == 0 || exact_[right] == 0)
    return false;
  const auto& [a, b] = std::pair{ranges_[left], ranges_[right]};
  switch (static_cast<spec::Operator>(node.what)) {
  case spec::Operator::Add:
  case spec::Operator::Subtract:
  case spec::Operator::Multiply: return a.constant() || b.constant();
  case spec::Operator::Divide: return b.constant();
  case spec::Operator::Remainder: // two turns at least, whatever the steps
    return a.constant()
               ? b.constant()
               : b.constant() && (std::int64_t{a.hi} - a.lo) / 2 >= std::abs(std::int64_t{b.lo});
  case spec::Operator::ShiftLeft:
  case spec::Operator::ShiftRight:
  case spec::Operator::And:
  case spec::Operator::Or: return a.constant() && b.constant();
  }
  return false;
}

void ValuesPass::check_operation(const Node& node, std::uint32_t index) {
  switch (node.kind) {
  case NodeKind::Indexed: check_index(node.span); break;
  case NodeKind::System:
    if (const auto& row = spec::variables[node.what]; row.access == spec::Access::ReadClears)
      note_clearing(node, row);
    break;
  case NodeKind::Binary: check_binary(node, index); break;
  case NodeKind::Call: check_call(node, index); break;
  case NodeKind::Letter:
  case NodeKind::Number:
  case NodeKind::Group:
  case NodeKind::Negate: break;
  }
}

void ValuesPass::note_clearing(const Node& node, const spec::VariableInfo& row) {
  const auto slot = clearing_slots[node.what];
  if (((cleared_on_line_ | cleared_) & bit(slot)) != 0)
    findings_.add(
        rules::ClearedByReading, node.span,
        fmt::format("`{}` is read again, but reading it has already reset it to 0", row.word),
        "copy it into a variable and use the copy");
  cleared_on_line_ |= bit(slot);
  if (!conditional_)
    cleared_ |= bit(slot);
}

void ValuesPass::check_binary(const Node& node, std::uint32_t index) {
  const auto op = static_cast<spec::Operator>(node.what);
  const auto& right = ranges_[index - 1];
  const auto& right_span = program_.nodes[index - 1].span;
  const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
  const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
  const auto most = spec::value_of(spec::Limit::GreatestShift);
  if (divides && right == Range::only(0)) {
    findings_.add(rules::DivisionByZero, right_span, "division by zero");
    ranges_[index] = {};
  } else if (shifts && right.misses(0, most)) {
    findings_.add(rules::ValueOutOfRange, right_span,
                  fmt::format("a shift must be 0 to {} bits, found {}", most, shown(right)));
    ranges_[index] = {};
  } else if (op == spec::Operator::Divide && ranges_[index] == Range::only(0)) {
    check_quotient(node, index);
  }
}

void ValuesPass::check_call(const Node& node, std::uint32_t index) {
  const auto& row = spec::functions[node.what];
  const auto& range = ranges_[index - 1];
  if (row.function == spec::Function::Rnd && range == Range::only(1) &&
      program_.nodes[index - 1].kind != NodeKind::Letter)
    findings_.add(rules::AlwaysOne, node.span, "`rnd 1` is always 1", "write `rnd 2` for 1 or 2");
  if (!range.misses(row.least, row.greatest))
    return;
  findings_.add(rules::ValueOutOfRange, program_.nodes[index - 1].span,
                fmt::format("`{}` takes {} or more, found {}", row.word, row.least, shown(range)));
  ranges_[index] = {};
}

} // namespace orb::compiler
