#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// The most likely candidate for a misspelt `word`: an equal word in another case first, then the
/// least edit distance (insert, delete, replace, swap of neighbours), at most a third of the word's
/// length and at least 1. The first of equals wins.
std::optional<std::string> closest(std::string_view word,
                                   std::span<const std::string_view> candidates);

/// The edit distance of two texts: insert, delete, replace or swap of neighbours, ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns "did you mean `…`?" with the closest candidate, or `otherwise` if none is close.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates,
                         std::string_view otherwise);
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates,
                         std::string_view otherwise);

/// The `count` candidates nearest to `word` by the distance of closest(), nearest first, without
/// duplicates. Candidates that change more than half of the word are left out.
std::vector<std::string> nearest(std::string_view word,
                                 std::span<const std::string_view> candidates, std::size_t count);

} // namespace orb
