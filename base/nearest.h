#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// The `count` candidates that are nearest to `word` by the distance of closest(), the nearest first,
/// each once; fewer where more than half of the word would have to change.
std::vector<std::string> nearest(std::string_view word,
                                 std::span<const std::string_view> candidates, std::size_t count);

} // namespace orb
