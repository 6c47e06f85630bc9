#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace orb {

/// The candidate that a misspelt `word` most likely meant: the same letters in another case first,
/// then the least edit distance (insert, delete, replace, swap of neighbours), at most a third of
/// the word's length and at least 1. Of equals the first wins.
std::optional<std::string> closest(std::string_view word,
                                   std::span<const std::string_view> candidates);

} // namespace orb
