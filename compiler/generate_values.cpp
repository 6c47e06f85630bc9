#include "compiler/generator.h"

namespace orb::compiler {

namespace {

constexpr std::array operations{Op::Multiply,  Op::Divide,     Op::Remainder,
                                Op::ShiftLeft, Op::ShiftRight, Op::Add,
                                Op::Subtract,  Op::And,        Op::Or};
static_assert(operations.size() == spec::operators.size() &&
              operations[static_cast<std::size_t>(Operator::ShiftRight)] == Op::ShiftRight &&
              operations[static_cast<std::size_t>(Operator::Or)] == Op::Or);

constexpr std::array functions{Op::Sqrt, Op::Rnd, Op::Abs};
static_assert(functions.size() == spec::functions.size() &&
              functions[static_cast<std::size_t>(Function::Abs)] == Op::Abs);

} // namespace

std::uint16_t Generator::constant(std::int32_t value) {
  if (chunk_.constants.size() >= most_registers && !constants_.contains(value)) {
    overflow_ = true;
    return constant_mark;
  }
  const auto [at, fresh] = constants_.try_emplace(
      value, static_cast<std::uint16_t>(constant_mark + chunk_.constants.size()));
  if (fresh)
    chunk_.constants.push_back(value);
  return at->second;
}

std::optional<std::int32_t> Generator::constant_in(std::uint16_t index) const {
  if (index < constant_mark)
    return std::nullopt;
  return chunk_.constants[index - constant_mark];
}

bool Generator::is_temporary(std::uint16_t index) {
  return index >= bytecode::first_temporary && index < constant_mark;
}

std::uint16_t Generator::temporary(std::size_t place) {
  chunk_.temporaries = std::max(chunk_.temporaries, static_cast<std::uint16_t>(place + 1));
  return static_cast<std::uint16_t>(bytecode::first_temporary + place);
}

std::uint16_t Generator::pop() {
  const std::uint16_t index = stack_.back();
  stack_.pop_back();
  return index;
}

void Generator::compute(Op op, std::uint16_t b, std::uint16_t c, std::uint16_t d) {
  const std::uint16_t to = temporary(stack_.size());
  emit(op, to, b, c, d);
  stack_.push_back(to);
}

void Generator::combine(Operator written) {
  const std::uint16_t right = pop();
  const std::uint16_t left = pop();
  const auto x = constant_in(left);
  const auto y = constant_in(right);
  if (const auto value = x && y ? bytecode::calculate(written, *x, *y) : std::nullopt) {
    stack_.push_back(constant(*value));
    return;
  }
  const Op op = operations[static_cast<std::size_t>(written)];
  if (y && *y > 1 && (op == Op::Divide || op == Op::Remainder))
    divide_by_constant(op, left, right, static_cast<std::uint32_t>(*y));
  else if (!(op == Op::Add && join(op, right, left)) && !join(op, left, right))
    compute(op, left, right);
}

void Generator::divide_by_constant(Op op, std::uint16_t left, std::uint16_t right,
                                   std::uint32_t divisor) {
  const bool quotient = op == Op::Divide;
  if (std::has_single_bit(divisor))
    compute(quotient ? Op::DivideByPower : Op::RemainderByPower, left, right,
            static_cast<std::uint16_t>(std::countr_zero(divisor)));
  else
    compute(quotient ? Op::DivideBy : Op::RemainderBy, left, right);
}

bool Generator::join(Op op, std::uint16_t left, std::uint16_t right) {
  constexpr std::array rows{std::array{Op::Multiply, Op::Add, Op::MultiplyAdd},
                            std::array{Op::DivideBy, Op::Subtract, Op::DivideSubtract},
                            std::array{Op::RemainderBy, Op::Add, Op::RemainderAdd}};
  for (const auto& [first, second, both] : rows)
    if (op == second && is_last(first, right, here())) {
      const auto last = chunk_.code.back();
      chunk_.code.pop_back();
      compute(both, last.b, last.c, left);
      return true;
    }
  return false;
}

void Generator::negate() {
  const std::uint16_t operand = pop();
  stack_.insert(stack_.end(), {constant(0), operand});
  combine(Operator::Subtract);
}

std::uint32_t Generator::too_deep(std::uint32_t root) const {
  std::uint32_t found = none;
  for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i)
    if (program_.nodes[i].depth > spec::value_of(spec::Limit::ExpressionLevels))
      found = std::min(found, program_.nodes[i].first);
  return found;
}

std::optional<std::uint16_t> Generator::value(std::uint32_t root) {
  const std::uint32_t stop = too_deep(root);
  for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i) {
    if (i == stop) {
      trap(BasicError::ExpressionTooComplex);
      return std::nullopt;
    }
    const auto& node = program_.nodes[i];
    switch (node.kind) {
    case NodeKind::Number: stack_.push_back(constant(node.value)); break;
    case NodeKind::Letter: stack_.push_back(node.what); break;
    case NodeKind::Indexed: compute(Op::LoadElement); break;
    case NodeKind::System: compute(Op::ReadSystem, node.what); break;
    case NodeKind::Group: break;
    case NodeKind::Negate: negate(); break;
    case NodeKind::Binary: combine(static_cast<Operator>(node.what)); break;
    case NodeKind::Call: compute(functions[node.what], pop()); break;
    }
  }
  return stack_.back();
}

void Generator::move(std::uint16_t to, std::uint16_t from) {
  if (is_temporary(from))
    chunk_.code.back().a = to; // the last instruction computed it
  else
    emit(Op::Copy, to, from);
}

std::optional<std::uint16_t> Generator::side_by_side(std::span<const Item> items) {
  const std::size_t first = stack_.size();
  for (const auto& item : items) {
    const std::uint16_t place = temporary(stack_.size());
    if (!value(item.value))
      return std::nullopt;
    move(place, pop());
    stack_.push_back(place);
  }
  return static_cast<std::uint16_t>(bytecode::first_temporary + first);
}

bool Generator::is_leaf(std::uint32_t root) const {
  const auto kind = program_.nodes[root].kind;
  return kind == NodeKind::Number || kind == NodeKind::Letter;
}

Relation Generator::relation_of(const Comparison& comparison) {
  return static_cast<Relation>(comparison.relation.value);
}

bool Generator::compare(const Comparison& comparison) {
  if (!value(comparison.left.value) || !value(comparison.right.value))
    return false;
  const auto left = stack_[stack_.size() - 2];
  const auto relation = relation_of(comparison);
  if (is_last(Op::RemainderByPower, left, here()) && constant_in(stack_.back()) == 0 &&
      (relation == Relation::Equal || relation == Relation::NotEqual)) {
    auto& last = chunk_.code.back(); // the remainder is 0 if the low bits are
    last = {Op::And, false, left, last.b, constant(*constant_in(last.c) - 1)};
  }
  return true;
}

void Generator::decide(const StatementNode& node) {
  const auto condition = program_.as<IfView>(node);
  // Both comparisons are evaluated before one is tested.
  if (!compare(condition.first) || (condition.second && !compare(*condition.second)))
    return;
  const auto& then = program_.statements[node.then_branch];
  const bool has_else = node.else_branch != none;
  const auto first = relation_of(condition.first);
  const auto last = relation_of(condition.last());
  if (!condition.second && select(node, first, stack_[0], stack_[1]))
    return;

  const bool either = condition.second && condition.joint->kind == ItemKind::Or;
  const std::uint32_t begin = here();
  if (condition.second)
    emit(with_relation(either ? Op::WhenEqual : Op::UnlessEqual, first), stack_[0], stack_[1]);
  const std::uint32_t end =
      emit(with_relation(Op::UnlessEqual, last), stack_[stack_.size() - 2], stack_.back());
  // Fold `then goto` into the test if nothing else remains to be done.
  const bool jumps = !has_else && !either && then.kind == Statement::Goto && !then.error &&
                     lead_to(end, program_.as<BranchView>(then).target.value);
  const std::uint32_t then_part = here();
  if (jumps)
    chunk_.code[end].op = with_relation(Op::WhenEqual, last);
  else
    statement(then);
  const std::uint32_t skip = has_else ? leave_branch() : none;
  for (std::uint32_t at = begin; at <= end; ++at) {
    chunk_.code[at].target = here();
    chunk_.code[at].ends_line = !has_else;
  }
  if (either) {
    chunk_.code[begin].target = then_part;
    chunk_.code[begin].ends_line = false;
  }
  if (!has_else)
    return;
  statement(program_.statements[node.else_branch]);
  if (skip != none)
    chunk_.code[skip].target = here();
}

} // namespace orb::compiler
