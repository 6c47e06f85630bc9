#pragma once

#include "base/diagnostic.h"
#include "compiler/analyse/flow.h"
#include "compiler/analyse/range.h"
#include "compiler/analyse/reading.h"
#include "compiler/text/program.h"

#include <cstdint>
#include <vector>

namespace orb::compiler {

/// A value, unknown before the run, that decides a branch.
struct Decision {
  Span span;                       ///< empty if there is no text to point at
  const orb::Text* when = nullptr; ///< the decision, in words
  std::uint32_t before = none;     ///< the previous one, an index into Trial::decisions
};

/// What stops a program on one of its paths, or keeps it in a loop for ever.
struct TrialFault {
  const Rule* rule = nullptr;
  Span span;
  Message message;
  Message help;
  std::uint32_t decision = none; ///< the last one on the path; none: it is the only path
  bool later = false;            ///< an earlier pass of the line succeeded
  bool certain = true;           ///< false: only some of the values stop it
};

struct Trial {
  std::vector<TrialFault> faults; ///< the first at each place
  std::vector<Decision> decisions;
};

/// Executes a program symbolically from its first line, within limits. Follows both branches where
/// a sensor or chance decides, and stops where it is unknown if both are possible. A loop that only
/// waits for a sensor decides nothing: the program continues after it or never.
Trial try_program(const Program& program, const Flow& flow);

} // namespace orb::compiler
