#pragma once

#include "structured/analyse/flow.h"

#include <optional>
#include <vector>

namespace orb::structured {

/// Less, equal and greater, as bits.
inline constexpr unsigned all_orders = 7;

/// What the tests of a program compare.
struct Orders {
  static constexpr std::uint32_t numbers = 4; ///< of each pair: together they are in one word

  /// Two terms that several tests compare. Each order that they can have has a number.
  struct Pair {
    std::uint32_t left;
    std::uint32_t right;
    std::uint32_t less; ///< the number of this order; those of equal and greater follow

    void insert_in(std::span<std::uint64_t> set, std::uint64_t orders) const {
      set[less / 64] |= orders << (less % 64);
    }
    void remove_from(std::span<std::uint64_t> set, std::uint64_t orders) const {
      set[less / 64] &= ~(orders << (less % 64));
    }
    /// The orders whose numbers are in a set.
    unsigned in(std::span<const std::uint64_t> set) const {
      return static_cast<unsigned>(set[less / 64] >> (less % 64)) & all_orders;
    }
  };
  struct Test {
    std::uint32_t pair = none;
    unsigned holds = 0; ///< in these orders
  };

  std::vector<Pair> pairs;
  std::vector<Test> tests; ///< of each line
};

/// The orders of what `relation` compares in which another one of the same terms holds; nothing for
/// other terms.
std::optional<unsigned> orders_as(const Code& code, const Relation& relation,
                                  const Relation& other);

/// Finds tests of the same terms, which do nothing but that; takes numbers from `next` on.
Orders read_orders(const Code& code, std::uint32_t& next);

} // namespace orb::structured
