#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// The changes allowed to control flow.
enum class BranchChanges : std::uint8_t {
  AsTheyAre, ///< only decided tests are removed
  Decided,   ///< also, jumps skip tests that are decided for them
  Split      ///< also, if nothing else changes, paths are split
};

/// Computes the ranges of variables at each line and applies them: removes tests with a certain
/// outcome, replaces variables that are always a known number, marks divisions and indices that
/// cannot fail, records indices that always fail, and stores ranges in terms. Preserves behaviour;
/// gives up without a change on programs that no robot has room for. Returns true if the program
/// changed.
bool use_values(Code& code, BranchChanges ways = BranchChanges::Decided);

} // namespace orb::structured
