#include "base/text/suggest.h"

#include "base/text/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace orb {

namespace {

constexpr std::size_t longest_word =
    64; // longer words are not misspellings, and the table is quadratic

/// Optimal string alignment distance, ignoring case. Distances over `most` are returned as `most` +
/// 1.
std::size_t distance(std::string_view a, std::string_view b, std::size_t most) {
  if (a.size() > b.size() + most || b.size() > a.size() + most)
    return most + 1;
  std::array<std::size_t, 3 * (longest_word + 1)> few;
  std::vector<std::size_t> many(b.size() > longest_word ? 3 * (b.size() + 1) : 0);
  auto* before = many.empty() ? few.data() : many.data();
  auto* above = before + b.size() + 1;
  auto* row = above + b.size() + 1;
  for (std::size_t j = 0; j <= b.size(); ++j)
    above[j] = j;
  auto least_above = std::size_t{0};
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    auto least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = to_lower(a[i - 1]) == to_lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && to_lower(a[i - 1]) == to_lower(b[j - 2]) &&
                           to_lower(a[i - 2]) == to_lower(b[j - 1]);
      if (swapped)
        row[j] = std::min(row[j], before[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least > most && least_above > most)
      return most + 1;
    least_above = least;
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  return distance(a, b, a.size() + b.size());
}

std::optional<std::string> closest(std::string_view word,
                                   std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > longest_word)
    return std::nullopt;
  for (const auto candidate : candidates)
    if (equal_words(word, candidate))
      return std::string(candidate);
  std::optional<std::string> best;
  // Replacing every letter is not a misspelling: `x` never becomes `y`.
  auto limit = std::min(std::max<std::size_t>(1, word.size() / 3) + 1, word.size());
  for (const auto candidate : candidates) {
    const auto d = distance(word, candidate, limit - 1);
    if (d < limit) {
      limit = d;
      best = std::string(candidate);
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates,
                         std::string_view otherwise) {
  const auto meant = closest(word, candidates);
  return meant && *meant != word ? fmt::format("did you mean `{}`?", *meant)
                                 : std::string(otherwise);
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates,
                         std::string_view otherwise) {
  const std::vector<std::string_view> views(candidates.begin(), candidates.end());
  return did_you_mean(word, views, otherwise);
}

std::vector<std::string> nearest(std::string_view word,
                                 std::span<const std::string_view> candidates, std::size_t count) {
  if (word.empty() || word.size() > longest_word)
    return {};
  const std::size_t limit = std::max<std::size_t>(1, word.size() / 2);
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (const auto candidate : candidates)
    if (const auto d = distance(word, candidate, limit); d <= limit)
      near.emplace_back(d, candidate);
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [d, name] : near)
    if (names.size() < count && std::find(names.begin(), names.end(), name) == names.end())
      names.emplace_back(name);
  return names;
}

} // namespace orb
