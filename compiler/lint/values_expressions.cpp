#include "compiler/lint/values_pass.h"

namespace orb::compiler {

void ValuesPass::evaluate(const StatementNode& statement) {
  const auto items = program_.items_of(statement);
  const auto last = std::find_if(items.rbegin(), items.rend(), [](const Item& item) {
    return item.kind == ItemKind::Expression || item.kind == ItemKind::Character;
  });
  if (last == items.rend())
    return;
  // A loop has set its letter to its start when it computes its end.
  const bool counts = statement.kind == spec::Statement::For && items[0].kind == ItemKind::Letter;
  for (auto n = evaluated_; n <= last->value; ++n) {
    ranges_[n] = evaluate(n);
    exact_[n] = exact(n);
    if (counts && n == items[1].value)
      set_letter(items[0].value, ranges_[n]);
  }
  evaluated_ = last->value + 1;
}

Range ValuesPass::compute(const Item& item) {
  if (!following_ && item.value < evaluated_)
    return ranges_[item.value];
  for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
    ranges_[n] = compute(n);
    exact_[n] = exact(n);
  }
  return ranges_[item.value];
}

Range ValuesPass::compute(std::uint32_t index) {
  const auto& node = program_.nodes[index];
  switch (node.kind) {
  case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
  case NodeKind::Letter: return now_.ranges[node.what];
  case NodeKind::Indexed: return {};
  case NodeKind::System: {
    const auto& row = spec::variables[node.what];
    return {row.least, row.greatest};
  }
  case NodeKind::Group: return ranges_[index - 1];
  case NodeKind::Negate: return negate(ranges_[index - 1]);
  case NodeKind::Binary: {
    const auto right = index - 1;
    return apply(static_cast<spec::Operator>(node.what), ranges_[program_.nodes[right].first - 1],
                 ranges_[right]);
  }
  case NodeKind::Call: return apply(spec::functions[node.what].function, ranges_[index - 1]);
  }
  return {};
}

bool ValuesPass::exact(std::uint32_t index) const {
  const auto& node = program_.nodes[index];
  switch (node.kind) {
  case NodeKind::Number: return !node.overflow;
  case NodeKind::Letter: return is_exact(node.what);
  case NodeKind::Indexed: return false;
  case NodeKind::System: return reaches_ends(spec::variables[node.what]);
  case NodeKind::Group:
  case NodeKind::Negate:
  case NodeKind::Call: return exact_[index - 1] != 0;
  case NodeKind::Binary: return is_exact_sum(node, index - 1);
  }
  return false;
}

bool ValuesPass::reaches_ends(const spec::VariableInfo& row) {
  constexpr std::int32_t byte = 255; // the greatest value of what a client sends
  return row.unit == "deg" ||
         (row.unit.empty() && row.greatest <= byte && row.variable != spec::Variable::Speed);
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

Range ValuesPass::evaluate(std::uint32_t index) {
  const auto& node = program_.nodes[index];
  switch (node.kind) {
  case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
  case NodeKind::Letter:
    if (letters_[node.what].first_used == nullptr)
      letters_[node.what].first_used = &node;
    return now_.ranges[node.what];
  case NodeKind::Indexed: check_index(node.span); return {};
  case NodeKind::System: return read_system(node);
  case NodeKind::Group: return ranges_[index - 1];
  case NodeKind::Negate: return negate(ranges_[index - 1]);
  case NodeKind::Binary: return evaluate_binary(node, index);
  case NodeKind::Call: return evaluate_call(node, index);
  }
  return {};
}

Range ValuesPass::read_system(const Node& node) {
  const auto& row = spec::variables[node.what];
  if (row.access == spec::Access::ReadClears)
    note_clearing(node, row);
  return {row.least, row.greatest};
}

void ValuesPass::note_clearing(const Node& node, const spec::VariableInfo& row) {
  std::uint32_t slot = 0; // few variables clear themselves; their order is their slot
  for (const auto& other : spec::variables) {
    if (other.variable == row.variable)
      break;
    slot += other.access == spec::Access::ReadClears ? 1 : 0;
  }
  if (((cleared_on_line_ | cleared_) & bit(slot)) != 0)
    findings_.add(
        rules::ClearedByReading, node.span,
        fmt::format("`{}` is read again, but reading it has already reset it to 0", row.word),
        "copy it into a variable and use the copy");
  cleared_on_line_ |= bit(slot);
  if (!conditional_)
    cleared_ |= bit(slot);
}

Range ValuesPass::evaluate_binary(const Node& node, std::uint32_t index) {
  const auto op = static_cast<spec::Operator>(node.what);
  const auto right_index = index - 1;
  const auto& right = ranges_[right_index];
  const auto& left = ranges_[program_.nodes[right_index].first - 1];
  const auto& right_span = program_.nodes[right_index].span;
  const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
  const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
  if (divides && right == Range::only(0)) {
    findings_.add(rules::DivisionByZero, right_span, "division by zero");
    return {};
  }
  const auto most = spec::value_of(spec::Limit::GreatestShift);
  if (shifts && right.misses(0, most)) {
    findings_.add(rules::ValueOutOfRange, right_span,
                  fmt::format("a shift must be 0 to {} bits, found {}", most, shown(right)));
    return {};
  }
  const auto result = apply(op, left, right);
  if (op == spec::Operator::Divide && result == Range::only(0))
    check_quotient(node, index);
  return result;
}

Range ValuesPass::evaluate_call(const Node& node, std::uint32_t index) {
  const auto& row = spec::functions[node.what];
  const auto& range = ranges_[index - 1];
  if (row.function == spec::Function::Rnd && range == Range::only(1) &&
      program_.nodes[index - 1].kind != NodeKind::Letter)
    findings_.add(rules::AlwaysOne, node.span, "`rnd 1` is always 1", "write `rnd 2` for 1 or 2");
  if (!range.misses(row.least, row.greatest))
    return apply(row.function, range);
  findings_.add(rules::ValueOutOfRange, program_.nodes[index - 1].span,
                fmt::format("`{}` takes {} or more, found {}", row.word, row.least, shown(range)));
  return {};
}

} // namespace orb::compiler
