#pragma once

#include "structured/lower/code.h"

#include <vector>

namespace orb::structured {

/// No robot runs more lines: it would take a day, at the rate that it is documented with.
inline constexpr std::int32_t most_lines_run = 1 << 28;
inline constexpr std::int32_t most_step = 4; ///< of a variable that counts
inline constexpr std::int32_t most_start = 1 << 29;
/// How far a variable that counts can get, in both directions.
inline constexpr std::int32_t most_count = most_start + most_lines_run * most_step;

/// Of each variable: whether it is only set to numbers and stepped, and so never wraps around.
std::vector<bool> counters_of(const Code& code);

/// What is known of a variable after a line, or `none`.
struct Proof {
  std::uint32_t variable = none;
  compiler::Range range;
};

/// Of each line: what is known after it has used an element. Its index was one of the array, or the
/// program has stopped: a test of the index that fails leads there with an index that is none.
std::vector<Proof> proofs_of(const Code& code);

} // namespace orb::structured
