#pragma once

#include "run/input.h"
#include "spec/limits.h"

#include <array>
#include <cstdint>
#include <map>

namespace orb::debug {

inline constexpr auto letters = spec::letter_count;
/// The symbol of the structured program in each letter, or structured::none.
using Holders = std::array<std::uint32_t, letters>;

/// The source variable in each letter just before a line of the robot, by line number.
/// structured::none if nothing was assigned yet, or it depends on the path. Several variables share
/// a letter over time, so this follows every path of the program. Empty for programs whose letters
/// are the names.
std::map<std::uint32_t, Holders> letter_holders(const run::Program& program);

} // namespace orb::debug
