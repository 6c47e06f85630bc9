#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// The candidate that a misspelt `word` most likely meant: the same letters in another case first,
/// then the least edit distance (insert, delete, replace, swap of neighbours), at most a third of
/// the word's length and at least 1. Of equals the first wins.
std::optional<std::string> closest(std::string_view word,
                                   std::span<const std::string_view> candidates);

/// How many letters differ between two texts: insert, delete, replace or swap of neighbours,
/// without regard to case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "did you mean `…`?" with the closest candidate, or `otherwise` where none is close.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates,
                         std::string_view otherwise);
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates,
                         std::string_view otherwise);

/// The `count` candidates that are nearest to `word` by the distance of closest(), the nearest
/// first, each once; fewer where more than half of the word would have to change.
std::vector<std::string> nearest(std::string_view word,
                                 std::span<const std::string_view> candidates, std::size_t count);

} // namespace orb
