#pragma once

#include <string>
#include <string_view>

namespace orb::cli {

/// The change from `before` to `after` as a unified diff with three lines of context, as `diff -u`
/// and `patch` know it; empty where the texts are equal.
std::string unified_diff(std::string_view name, std::string_view before, std::string_view after);

} // namespace orb::cli
