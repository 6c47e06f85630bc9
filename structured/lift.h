#pragma once

#include "base/diagnostic.h"
#include "compiler/program.h"

#include <string>
#include <vector>

namespace orb::structured {

/// A numbered program as a structured one, and what is to be said about the numbered one.
struct Lifted {
  std::string text; ///< in canonical layout, without errors; empty where a finding is an error
  std::vector<Diagnostic> findings; ///< about the numbered program
};

/// Recovers loops, blocks and subs of a program that has no errors. What fits no block becomes
/// labels and `goto`; what structured programs cannot say is refused at its line. Lines that
/// nothing reaches are left out, with a finding. Prints, lights and drives of the two programs are
/// the same, but that a print too long for the robot arrives whole.
Lifted lift(const compiler::Program& program);

} // namespace orb::structured
