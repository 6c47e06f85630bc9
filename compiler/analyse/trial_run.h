#pragma once

#include "base/diagnostic.h"
#include "compiler/analyse/flow.h"
#include "compiler/analyse/range.h"
#include "compiler/text/program.h"

#include <cstdint>
#include <vector>

namespace orb::compiler {

/// A value that decides where a program goes, and that nobody knows before it runs.
struct Decision {
  Span span; ///< empty where nothing is written that could be pointed at
  Holds holds = Holds::Yes;
  std::uint32_t before = none; ///< the one before, an index into Trial::decisions
};

/// What stops a program on one of its ways.
struct TrialFault {
  const Rule* rule = nullptr;
  Span span;
  Message message;
  Message help;
  std::uint32_t decision = none; ///< the last one on the way; none: there is no other way
  bool later = false;            ///< the line has run through before
};

struct Trial {
  std::vector<TrialFault> faults; ///< the first of each place
  std::vector<Decision> decisions;
};

/// Runs a program from its first line, for a while: along both ways where a sensor or chance
/// decides, and no further where nobody can say whether there are two. A loop that only waits for a
/// sensor decides nothing: the program goes on after it, or never.
Trial try_program(const Program& program, const Flow& flow);

} // namespace orb::compiler
