#include "structured/analyse/orders.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace {

std::uint64_t hash_of(const Code& code, std::uint32_t term) {
  const auto& node = code.terms[term];
  if (node.kind == TermKind::Number)
    return static_cast<std::uint32_t>(node.value);
  return std::uint64_t{node.kind == TermKind::Variable ? node.left : node.what} << 32 | node.size;
}

/// Gives two tests of the same terms the numbers of these.
void pair_up(const Code& code, std::uint32_t i, std::uint32_t other, Orders& orders,
             std::uint32_t& next) {
  const auto& one = code.conditions[code.lines[i].condition].first;
  const auto& two = code.conditions[code.lines[other].condition].first;
  const bool as_it = same(code, one.left, two.left) && same(code, one.right, two.right);
  if (!as_it && !(same(code, one.left, two.right) && same(code, one.right, two.left)))
    return;
  if (orders.tests[i].pair == none) {
    orders.tests[i] = {static_cast<std::uint32_t>(orders.pairs.size()), orders_of(one.comparison)};
    orders.pairs.push_back({one.left, one.right, next});
    next += 3;
  }
  orders.tests[other] = {orders.tests[i].pair,
                         orders_of(as_it ? two.comparison : mirrored(two.comparison))};
}

} // namespace

void Orders::Pair::insert_in(std::span<std::uint64_t> set, unsigned orders) const {
  for (std::uint32_t n = 0; n < 3; ++n)
    if ((orders >> n & 1) != 0)
      insert(set, less + n);
}

void Orders::Pair::remove_from(std::span<std::uint64_t> set, unsigned orders) const {
  for (std::uint32_t n = 0; n < 3; ++n)
    if ((orders >> n & 1) != 0)
      remove(set, less + n);
}

unsigned Orders::Pair::in(std::span<const std::uint64_t> set) const {
  unsigned orders = 0;
  for (std::uint32_t n = 0; n < 3; ++n)
    orders |= contains(set, less + n) ? 1U << n : 0U;
  return orders;
}

Orders read_orders(const Code& code, std::uint32_t& next) {
  Orders orders;
  orders.tests.resize(code.lines.size());
  std::vector<std::pair<std::uint64_t, std::uint32_t>> comparing; // a hash of the terms, a line
  for (std::uint32_t i = 0; i < code.lines.size(); ++i) {
    const auto& line = code.lines[i];
    if (line.kind != LineKind::If || line.guard)
      continue;
    const auto& [first, second, glue] = code.conditions[line.condition];
    if (glue == Glue::None && effects_of(code, line) == 0)
      comparing.push_back({hash_of(code, first.left) + hash_of(code, first.right), i});
  }
  std::sort(comparing.begin(), comparing.end());
  for (std::size_t n = 0; n < comparing.size(); ++n) {
    const auto [hash, i] = comparing[n];
    if (orders.tests[i].pair != none)
      continue; // so do all that are the same
    for (auto other = n + 1; other < comparing.size() && comparing[other].first == hash; ++other)
      if (orders.tests[comparing[other].second].pair == none)
        pair_up(code, i, comparing[other].second, orders, next);
  }
  return orders;
}

} // namespace orb::structured
