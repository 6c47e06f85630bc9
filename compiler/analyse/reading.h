#pragma once

#include "compiler/analyse/orders.h"
#include "compiler/text/program.h"

#include <optional>
#include <span>

namespace orb::compiler {

// Matches simple expressions; parentheses are ignored.

inline const Node& bare(const Program& program, const Item& item) {
  auto n = item.value;
  while (program.nodes[n].kind == NodeKind::Group)
    --n;
  return program.nodes[n];
}

/// The literal number.
inline std::optional<std::int32_t> number_in(const Program& program, const Item& item) {
  const auto& node = bare(program, item);
  return node.kind == NodeKind::Number && !node.overflow ? std::optional(node.value) : std::nullopt;
}

/// The literal number, including negative ones such as `-5` or `0 - 5`.
inline std::optional<std::int32_t> constant_in(const Program& program, const Item& item) {
  if (const auto number = number_in(program, item))
    return number;
  const auto& root = bare(program, item);
  const auto& nodes = program.nodes;
  const auto last = static_cast<std::size_t>(&root - nodes.data()) - 1;
  const bool negates = root.kind == NodeKind::Negate ||
                       (root.kind == NodeKind::Binary &&
                        static_cast<spec::Operator>(root.what) == spec::Operator::Subtract &&
                        nodes[root.first].kind == NodeKind::Number &&
                        nodes[root.first].value == 0 && root.first + 1 == last);
  if (!negates || nodes[last].kind != NodeKind::Number || nodes[last].overflow)
    return std::nullopt;
  return -nodes[last].value;
}

inline std::optional<spec::Variable> sensor_in(const Program& program, const Item& item) {
  const auto& node = bare(program, item);
  return node.kind == NodeKind::System ? std::optional(static_cast<spec::Variable>(node.what))
                                       : std::nullopt;
}

/// The letter, 0 for A.
inline std::optional<std::uint8_t> letter_in(const Program& program, const Item& item) {
  const auto& node = bare(program, item);
  return node.kind == NodeKind::Letter ? std::optional(node.what) : std::nullopt;
}

/// All nodes of an expression; empty for any other item.
inline std::span<const Node> nodes_of(const Program& program, const Item& item) {
  if (item.kind != ItemKind::Expression && item.kind != ItemKind::Character)
    return {};
  const auto first = program.nodes[item.value].first;
  return {program.nodes.data() + first, item.value - first + 1};
}

/// Selects if a comparison holds.
enum class Holds : std::uint8_t { Yes, No };

/// The orders of the two sides for which a comparison holds, or for which it does not.
inline Orders orders_of(const Comparison& comparison, Holds holds = Holds::Yes) {
  const auto orders = orders_of(static_cast<spec::Relation>(comparison.relation.value));
  return holds == Holds::Yes ? orders : opposite(orders);
}

/// A comparison of some value with a number.
struct Bound {
  Orders orders;
  std::int64_t number;

  bool holds(std::int64_t value) const { return compiler::holds(orders, value, number); }
};

/// A test of a sensor with a number, with the sides in either order.
struct SensorTest {
  spec::Variable sensor;
  Orders orders;
  std::int32_t number;
  const Item* at; ///< the number's item

  bool holds(std::int64_t value) const { return compiler::holds(orders, value, number); }
};

inline std::optional<SensorTest> sensor_test(const Program& program, const Comparison& comparison) {
  const auto orders = orders_of(comparison);
  if (const auto number = constant_in(program, comparison.right))
    if (const auto sensor = sensor_in(program, comparison.left))
      return SensorTest{*sensor, orders, *number, &comparison.right};
  if (const auto number = constant_in(program, comparison.left))
    if (const auto sensor = sensor_in(program, comparison.right))
      return SensorTest{*sensor, mirrored(orders), *number, &comparison.left};
  return std::nullopt;
}

} // namespace orb::compiler
