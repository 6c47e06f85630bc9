#pragma once

// Private to testing/.

#include "repair/tokens.h"

#include <span>
#include <string_view>

// Removes the punctuation of other test frameworks and languages from a line before it is read.

namespace orb::testing {

/// One small rewrite.
struct Plainer {
  std::string_view what; ///< what it does
  void (*apply)(repair::Tokens& line);
  std::string_view before; ///< example before
  std::string_view after;
};

std::span<const Plainer> plainers();

/// Applies all rewrites in order.
repair::Tokens plain_line(repair::Tokens line);

} // namespace orb::testing
