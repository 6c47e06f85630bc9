#pragma once

#include "spec/basic.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace orb::compiler {

/// The orders of two numbers in which a comparison holds, as bits: `<=` holds for less and for
/// equal.
enum class Orders : std::uint8_t {
  Less = 1,
  Equal = 2,
  LessEqual = Less | Equal,
  Greater = 4,
  NotEqual = Less | Greater,
  GreaterEqual = Greater | Equal,
};

constexpr bool has(Orders orders, Orders one) {
  return (static_cast<unsigned>(orders) & static_cast<unsigned>(one)) != 0;
}

constexpr bool holds(Orders orders, std::int64_t left, std::int64_t right) {
  return has(orders, left < right ? Orders::Less : left == right ? Orders::Equal : Orders::Greater);
}

/// Those in which the comparison does not hold.
constexpr Orders opposite(Orders orders) {
  constexpr unsigned all = 7; // the three bits
  return static_cast<Orders>(all ^ static_cast<unsigned>(orders));
}

/// Those of the same comparison with its sides exchanged.
constexpr Orders mirrored(Orders orders) {
  const auto bits = static_cast<unsigned>(orders);
  return static_cast<Orders>((bits & 1) << 2 | (bits & 2) | bits >> 2);
}

constexpr Orders orders_of(spec::Relation relation) {
  switch (relation) {
  case spec::Relation::Equal: return Orders::Equal;
  case spec::Relation::NotEqual: return Orders::NotEqual;
  case spec::Relation::Less: return Orders::Less;
  case spec::Relation::Greater: break;
  }
  return Orders::Greater;
}

/// The relation that holds for these; the robot has none for `<=` and `>=`.
constexpr spec::Relation relation_of(Orders orders) {
  for (const auto one : {spec::Relation::Equal, spec::Relation::NotEqual, spec::Relation::Less})
    if (orders_of(one) == orders)
      return one;
  return spec::Relation::Greater;
}

/// The sign of a comparison that holds for these. `unequal` is the one for less and greater: `!` on
/// a line of the robot, `<>` in a structured program.
constexpr std::string_view sign_of(Orders orders, std::string_view unequal) {
  constexpr std::array<std::string_view, 7> signs{"", "<", "=", "<=", ">", "", ">="};
  return orders == Orders::NotEqual ? unequal : signs[static_cast<std::size_t>(orders)];
}

} // namespace orb::compiler
