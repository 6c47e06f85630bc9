#include "bytecode/arithmetic.h"
#include "structured/meaning/symbols.h"

#include <algorithm>
#include <cmath>

namespace orb::structured {
namespace {

bool has_effect(const Node& node) {
  if (node.kind == NodeKind::Builtin)
    return static_cast<spec::Function>(node.what) == spec::Function::Rnd;
  return node.kind == NodeKind::Call || // a function may have any effect
         (node.kind == NodeKind::System &&
          spec::variables[node.what].access == spec::Access::ReadClears);
}

} // namespace

std::optional<Constant> evaluate(const Program& program, const Names& names, std::uint32_t root) {
  if (const auto& leaf = program.nodes[root]; leaf.kind == NodeKind::Number)
    return Constant{leaf.value, false};
  std::vector<Constant> stack;
  const auto pop = [&] {
    const auto top = stack.back();
    stack.pop_back();
    return top;
  };
  for (auto n = program.nodes[root].first; n <= root; ++n) {
    const auto& node = program.nodes[n];
    switch (node.kind) {
    case NodeKind::Number: stack.push_back({node.value, false}); break;
    case NodeKind::Duration: stack.push_back({node.value, true}); break;
    case NodeKind::Name: {
      const auto index = names.of_node[n];
      if (index == none || names.symbols[index].kind != SymbolKind::Constant)
        return std::nullopt;
      stack.push_back({names.symbols[index].value, names.symbols[index].duration});
      break;
    }
    case NodeKind::Negate: stack.back().value = bytecode::subtract(0, stack.back().value); break;
    case NodeKind::Builtin: {
      auto& value = stack.back().value;
      const auto function = static_cast<spec::Function>(node.what);
      if (function == spec::Function::Rnd || (function == spec::Function::Sqrt && value < 0))
        return std::nullopt;
      value = function == spec::Function::Abs
                  ? bytecode::absolute(value)
                  : static_cast<std::int32_t>(std::sqrt(static_cast<double>(value)));
      break;
    }
    case NodeKind::Least:
    case NodeKind::Greatest: {
      const auto b = pop();
      auto& a = stack.back();
      a.value =
          node.kind == NodeKind::Least ? std::min(a.value, b.value) : std::max(a.value, b.value);
      a.duration = a.duration || b.duration;
      break;
    }
    case NodeKind::Binary: {
      const auto b = pop();
      auto& a = stack.back();
      const auto value =
          bytecode::calculate(static_cast<spec::Operator>(node.what), a.value, b.value);
      if (!value)
        return std::nullopt;
      a = {*value, a.duration || b.duration};
      break;
    }
    case NodeKind::System:
    case NodeKind::Element:
    case NodeKind::Call:
    case NodeKind::Relation:
    case NodeKind::Not:
    case NodeKind::And:
    case NodeKind::Or: return std::nullopt;
    }
  }
  return stack.back();
}

bool has_effects(const Program& program, const Statement& statement) {
  for (const auto& item : program.items_of(statement))
    if (item.kind == ItemKind::Expression)
      for (auto n = program.nodes[item.value].first; n <= item.value; ++n)
        if (has_effect(program.nodes[n]))
          return true;
  return false;
}

} // namespace orb::structured
