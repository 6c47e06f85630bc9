#pragma once

// Private to testing/.

#include "base/time.h"
#include "repair/arrange.h"
#include "repair/repair.h"

#include <string>
#include <vector>

namespace orb::testing {

/// What the rest of the file says.
struct Elsewhere {
  Duration bound{}; ///< after how long a run is stopped
  bool has_course = false;
  bool may_have_zones = false;
  std::string near_by;    ///< the tolerance of the last place; empty without one
  std::string heading_by; ///< the same of headings
  bool has_bound = false; ///< the file says how long a run is
  bool has_texts = false; ///< lines that begin with a quote, as those below `prints`
};

/// A line with its words and values in the documented order: first what is expected, then how
/// often, then when; in the words of test files.
std::vector<repair::Rephrased> rephrase(const repair::Tokens& line, const Elsewhere& elsewhere);

/// What an expectation is about, without its verb and time; empty where it is about several things.
std::string what_is_expected(const repair::Tokens& line);

} // namespace orb::testing
