#include "structured/analyse/orders.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace {

/// The same for terms that are the same.
std::uint32_t hash_of(const Code& code, std::uint32_t term) {
  const auto& node = code.terms[term];
  const auto what = node.kind == TermKind::Number     ? static_cast<std::uint32_t>(node.value)
                    : node.kind == TermKind::Variable ? node.left
                                                      : node.what;
  return what << 8 ^ node.size;
}

/// Gives two tests of the same terms the numbers of these.
void pair_up(const Code& code, std::uint32_t i, std::uint32_t other, Orders& orders,
             std::uint32_t& next) {
  const auto& one = code.conditions[code.lines[i].condition].first;
  const auto& two = code.conditions[code.lines[other].condition].first;
  const auto holds = orders_as(code, one, two);
  if (!holds)
    return;
  if (orders.tests[i].pair == none) {
    orders.tests[i] = {static_cast<std::uint32_t>(orders.pairs.size()), orders_of(one.comparison)};
    orders.pairs.push_back({one.left, one.right, next});
    next += Orders::numbers;
  }
  orders.tests[other] = {orders.tests[i].pair, *holds};
}

} // namespace

std::optional<unsigned> orders_as(const Code& code, const Relation& relation,
                                  const Relation& other) {
  if (same(code, relation.left, other.left) && same(code, relation.right, other.right))
    return orders_of(other.comparison);
  if (same(code, relation.left, other.right) && same(code, relation.right, other.left))
    return orders_of(mirrored(other.comparison));
  return std::nullopt;
}

Orders read_orders(const Code& code, std::uint32_t& next) {
  next = (next + Orders::numbers - 1) / Orders::numbers * Orders::numbers;
  Orders orders;
  orders.tests.resize(code.lines.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> comparing; // a hash of the terms, a line
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
