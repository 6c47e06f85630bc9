#pragma once

// Private to testing/.

#include "repair/tokens.h"

#include <span>
#include <string_view>

// The signs of other test frameworks and of other languages, taken off a line before it is read.

namespace orb::testing {

/// One small rewrite.
struct Plainer {
  std::string_view what; ///< it does
  void (*apply)(repair::Tokens& line);
  std::string_view before; ///< an example
  std::string_view after;
};

std::span<const Plainer> plainers();

/// A line after all of them, one after the other.
repair::Tokens plain_line(repair::Tokens line);

} // namespace orb::testing
