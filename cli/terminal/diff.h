#pragma once

#include <string>
#include <string_view>

namespace orb::cli {

/// A unified diff from `before` to `after` with three lines of context, as `diff -u` prints it;
/// empty if the texts are equal.
std::string unified_diff(std::string_view name, std::string_view before, std::string_view after);

} // namespace orb::cli
