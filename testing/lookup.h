#pragma once

#include "testing/suite.h"

#include <vector>

// What the names in the expectations of a test mean.

namespace orb::testing {

/// What a name means in a program, or why it means nothing.
struct Lookup {
  Meaning meaning;
  const Rule* rule = nullptr; ///< of the finding, where there is a problem
  Message help;
};

/// One word of an expectation.
Lookup look_up_alone(const Expectation& one, const SuiteFile& file, const Prepared& program);

/// All that an expectation speaks of: itself, what is joined, and the other one.
std::vector<const Expectation*> parts_of(const Expectation& one);

/// What an expectation means with all its parts.
Meaning look_up(const Expectation& one, const SuiteFile& file, const Prepared& program);

} // namespace orb::testing
