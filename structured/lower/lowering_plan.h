#pragma once

#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace orb::structured {

/// The maximum nesting of inlined routines: the compiler recurses once for each.
inline constexpr std::size_t deepest_inline = 63;

/// Decisions on subs and loops, made before lowering.
struct Plan {
  std::vector<bool> inlined;        ///< of each routine: inlined into its callers
  std::vector<bool> needed;         ///< of each routine: reachable from the main program
  std::vector<bool> native;         ///< of each statement: a loop that becomes the robot's `for`
  std::vector<std::uint32_t> chain; ///< routines that nest deeper than the robot's call stack
};

/// Inlines routines that are called once or are too deep in a chain of calls. Turns the innermost
/// loops into the robot's own, up to four deep, if no jump leaves them.
Plan plan(const Program& program, const Names& names);

} // namespace orb::structured
