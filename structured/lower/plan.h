#pragma once

#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace orb::structured {

/// How deep routines are written into each other: the compiler goes down once for each.
inline constexpr std::size_t deepest_inline = 63;

/// What is decided about subs and loops before the first line is written.
struct Plan {
  std::vector<bool> inlined;        ///< of each routine: written into its callers
  std::vector<bool> needed;         ///< of each routine: reached from the main program
  std::vector<bool> native;         ///< of each statement: a loop that becomes the robot's `for`
  std::vector<std::uint32_t> chain; ///< routines that call each other deeper than the robot follows
};

/// Inlines what is called once, or stands too deep in a chain of calls; makes the innermost loops
/// the robot's own, four deep, where nothing jumps out of them.
Plan plan(const Program& program, const Names& names);

} // namespace orb::structured
