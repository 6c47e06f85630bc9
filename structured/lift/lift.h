#pragma once

#include "base/diagnostic.h"
#include "compiler/check.h"

#include <string>
#include <vector>

namespace orb::structured {

/// A numbered program as a structured one, and what is to be said about the numbered one.
struct Lifted {
  std::string text; ///< in canonical layout, without errors; empty where a finding is an error
  std::vector<Diagnostic> findings; ///< about the numbered program, but nothing that lint said
};

/// Recovers loops, blocks and subs of a checked program. What fits no block becomes labels and
/// `goto`; a program with errors is refused with them, what structured programs cannot say at its
/// line. Lines that nothing reaches are left out, with a finding. Prints, lights and drives of the
/// two programs are the same, but that a print too long for the robot arrives whole.
Lifted lift(const compiler::Checked& checked);

} // namespace orb::structured
