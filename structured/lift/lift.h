#pragma once

#include "base/diagnostic.h"
#include "compiler/check.h"

#include <string>
#include <vector>

namespace orb::structured {

/// A numbered program converted to a structured one, and findings about the numbered one.
struct Lifted {
  std::string text; ///< in canonical layout, without errors; empty if a finding is an error
  std::vector<Diagnostic> findings; ///< about the numbered program, without the findings of lint
};

/// Recovers loops, blocks and subs of a checked program. What fits no block becomes labels and
/// `goto`. Refuses a program with errors, and reports the line that structured programs cannot
/// express. Leaves out unreachable lines, with a finding. The two programs print, light and drive
/// the same, except that a print too long for the robot arrives whole.
Lifted lift(const compiler::Checked& checked);

} // namespace orb::structured
