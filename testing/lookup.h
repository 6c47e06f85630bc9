#pragma once

#include "testing/suite.h"

#include <vector>

// Looks up the names in the expectations of a test.

namespace orb::testing {

/// What a name refers to in a program, or why it refers to nothing.
struct Lookup {
  Meaning meaning;
  const Rule* rule = nullptr; ///< of the finding, if there is a problem
  Message help;
};

/// Looks up one expectation, without those joined to it.
Lookup look_up_alone(const Expectation& one, const SuiteFile& file, const Prepared& program);

/// Lists an expectation with everything joined to it and the other one it refers to.
std::vector<const Expectation*> parts_of(const Expectation& one);

/// Looks up an expectation with all its parts.
Meaning look_up(const Expectation& one, const SuiteFile& file, const Prepared& program);

} // namespace orb::testing
