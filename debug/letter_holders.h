#pragma once

#include "run/input.h"
#include "spec/limits.h"

#include <array>
#include <cstdint>
#include <map>

namespace orb::debug {

inline constexpr auto letters = spec::letter_count;
/// Of each letter a symbol of the structured program, or structured::none.
using Holders = std::array<std::uint32_t, letters>;

/// Which variable of the source each letter holds just before a line of the robot, by the line's
/// number; structured::none where nothing was put there yet, or it depends on the way. A letter
/// serves several variables, one after the other, so this follows every way that the program can
/// take. Empty where the letters are the names.
std::map<std::uint32_t, Holders> letter_holders(const run::Program& program);

} // namespace orb::debug
