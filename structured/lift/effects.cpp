#include "structured/lift/effects.h"

#include "spec/limits.h"

namespace orb::structured::lifting {
namespace {

using spec::Operator;

bool is_number(const compiler::Program& program, std::uint32_t node, std::int32_t least) {
  const auto& leaf = program.nodes[node];
  return leaf.kind == compiler::NodeKind::Number && leaf.value >= least;
}

/// True if the node itself, apart from its operands, can stop the program or has side effects.
bool node_acts(const compiler::Program& program, std::uint32_t n) {
  const auto& node = program.nodes[n];
  switch (node.kind) {
  case compiler::NodeKind::Indexed: return true;
  case compiler::NodeKind::System:
    return spec::variables[node.what].access == spec::Access::ReadClears;
  case compiler::NodeKind::Call:
    return static_cast<spec::Function>(node.what) != spec::Function::Abs;
  case compiler::NodeKind::Binary: {
    const auto op = static_cast<Operator>(node.what);
    const bool shifts = op == Operator::ShiftLeft || op == Operator::ShiftRight;
    if (op == Operator::Divide || op == Operator::Remainder)
      return !is_number(program, n - 1, 1);
    return shifts && !(is_number(program, n - 1, 0) &&
                       program.nodes[n - 1].value <= spec::value_of(spec::Limit::GreatestShift));
  }
  case compiler::NodeKind::Number:
  case compiler::NodeKind::Letter:
  case compiler::NodeKind::Group:
  case compiler::NodeKind::Negate: return false;
  }
  return false;
}

bool is_prepared(const compiler::Program& program, const compiler::StatementNode& test) {
  const auto view = program.as<compiler::IfView>(test);
  return view.second && (acts(program, view.second->left) || acts(program, view.second->right));
}

} // namespace

bool acts(const compiler::Program& program, const compiler::Item& item) {
  for (auto n = program.nodes[item.value].first; n <= item.value; ++n)
    if (node_acts(program, n))
      return true;
  return false;
}

std::vector<bool> prepared_tests(const compiler::Program& program, const ControlFlow& ways) {
  std::vector<bool> prepared(ways.steps.size(), false);
  for (std::size_t s = 0; s < ways.steps.size(); ++s) {
    const auto& statement = program.statements[ways.steps[s].statement];
    prepared[s] = statement.kind == spec::Statement::If && is_prepared(program, statement);
  }
  return prepared;
}

} // namespace orb::structured::lifting
