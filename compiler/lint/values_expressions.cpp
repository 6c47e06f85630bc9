#include "compiler/lint/values_pass.h"

namespace orb::compiler {
namespace {

/// By variable: its index among the variables that reading resets.
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

/// A sensor, given its index in `spec::variables`.
Value sensor(std::size_t index, const std::optional<Range>& usual) {
  const auto& row = spec::variables[index];
  Value value{usual.value_or(Range{row.least, row.greatest})};
  value.exact = value.dense = usual || reaches_ends[index];
  if (usual) // the origin tells check_usual() which are times
    value.origin = row.unit == "ms" ? Origin::World : Origin::Motion;
  value.fresh = usual && row.unit == "cm"; // both places are independent of each other
  return value;
}

} // namespace

Value ValuesPass::known_of_sensor(std::size_t index) const {
  const auto own = letter_of_sensor_[index];
  return own != 0 && now_[own].bounded
             ? now_[own]
             : sensor(index, usual_ == nullptr ? std::nullopt : (*usual_)[index]);
}

void ValuesPass::compute(std::uint32_t begin, std::uint32_t end) {
  for (auto n = begin; n < end; ++n) {
    const auto& node = program_.nodes[n];
    if (node.kind == NodeKind::Letter)
      known_[n] = now_[node.what];
    else if (node.kind == NodeKind::System)
      known_[n] = known_of_sensor(node.what);
    else
      known_[n] = value_of(program_, n, known_);
    if (!following_)
      check_node(node, n);
  }
}

void ValuesPass::check_node(const Node& node, std::uint32_t index) {
  switch (node.kind) {
  case NodeKind::Letter: note_use(node); break;
  case NodeKind::Indexed: check_index(node.span); break;
  case NodeKind::System:
    if (const auto& row = spec::variables[node.what]; row.access == spec::Access::ReadClears)
      note_clearing(node, row);
    break;
  case NodeKind::Call: check_call(node, index); break;
  case NodeKind::Binary: check_binary(node, index); break;
  case NodeKind::Number:
  case NodeKind::Group:
  case NodeKind::Negate: break;
  }
}

void ValuesPass::note_risk(std::uint32_t root) {
  const auto begin = program_.nodes.begin() + program_.nodes[root].first;
  const auto end = program_.nodes.begin() + root + 1;
  at_risk_ = at_risk_ || std::any_of(begin, end, [](const Node& node) {
               return node.kind == NodeKind::Letter || node.kind == NodeKind::Indexed;
             });
}

void ValuesPass::note_uses(const StatementNode& statement) {
  if (statement.error)
    return;
  for (auto n = statement.nodes_begin; n < statement.nodes_end; ++n)
    if (program_.nodes[n].kind == NodeKind::Letter)
      note_use(program_.nodes[n]);
    else
      indexed_used_ = indexed_used_ || program_.nodes[n].kind == NodeKind::Indexed;
  for (const auto& item : program_.items_of(statement))
    indexed_used_ = indexed_used_ || item.kind == ItemKind::Indexed;
}

void ValuesPass::note_clearing(const Node& node, const spec::VariableInfo& row) {
  const auto slot = clearing_slots[node.what];
  // A copy after a test may be meant to reset it.
  const auto above = program_.statements[flow_.code[code_].statement].kind == spec::Statement::If
                         ? cleared_above_
                         : LetterSet{0};
  if (((cleared_on_line_ | cleared_ | above) & bit(slot)) != 0)
    findings_.add(rules::ClearedByReading, node.span, texts::IsReadAgain(row.word),
                  texts::CopyIt());
  cleared_on_line_ |= bit(slot);
  if (!conditional_)
    cleared_ |= bit(slot);
}

void ValuesPass::check_binary(const Node& node, std::uint32_t index) {
  const auto op = static_cast<spec::Operator>(node.what);
  const auto& right = known_[index - 1].range;
  const auto& right_span = program_.nodes[index - 1].span;
  const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
  const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
  const auto most = spec::value_of(spec::Limit::GreatestShift);
  if ((divides && right.has(0)) || (shifts && (right.lo < 0 || right.hi > most)))
    note_risk(index - 1);
  if (divides && right == Range::only(0)) {
    findings_.add(rules::DivisionByZero, right_span,
                  program_.nodes[index - 1].kind == NodeKind::Number
                      ? texts::DividesByZero()
                      : texts::DividesByZeroHere(program_.text_of(right_span)));
    known_[index].range = {};
  } else if (shifts && right.misses(0, most)) {
    findings_.add(rules::ValueOutOfRange, right_span,
                  texts::FoundValue(texts::ShiftMustBe(most), shown(right)));
    known_[index].range = {};
  } else if (op == spec::Operator::Divide && known_[index].range == Range::only(0)) {
    check_quotient(node, index);
  }
}

void ValuesPass::check_call(const Node& node, std::uint32_t index) {
  const auto& row = spec::functions[node.what];
  const auto& range = known_[index - 1].range;
  if (row.function == spec::Function::Rnd && range == Range::only(1) &&
      program_.nodes[index - 1].kind != NodeKind::Letter)
    findings_.add(rules::AlwaysOne, node.span, texts::RndIsAlwaysOne(), texts::WriteRndTwo());
  if (range.lo < row.least || range.hi > row.greatest)
    note_risk(index - 1);
  if (usual_ != nullptr)
    return check_usual(known_[index - 1], program_.nodes[index - 1].span, row.least, row.greatest,
                       texts::TakesOrMore(row.word, row.least));
  if (!range.misses(row.least, row.greatest))
    return;
  findings_.add(rules::ValueOutOfRange, program_.nodes[index - 1].span,
                texts::FoundValue(texts::TakesOrMore(row.word, row.least), shown(range)));
  known_[index].range = {};
}

} // namespace orb::compiler
