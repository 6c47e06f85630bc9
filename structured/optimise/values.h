#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// What happens to the ways of a program.
enum class Ways : std::uint8_t {
  AsTheyAre, ///< none changes but for tests that are decided
  Decided,   ///< also, jumps lead past tests that are decided for them
  Split      ///< also, where nothing else changes, ways are split
};

/// Computes what values variables can have at each line, and uses it: tests with a certain outcome
/// go, variables that are always a known number become that number, divisions and indices that
/// cannot fail are marked, indices that can only fail are noted, and terms learn their ranges.
/// Keeps what the program does; gives up, changing nothing, on programs that no robot holds. True
/// where something changed.
bool use_values(Code& code, Ways ways = Ways::Decided);

} // namespace orb::structured
