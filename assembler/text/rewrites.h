#pragma once

// Private to assembler/.

#include "repair/tokens.h"

#include <span>
#include <string_view>

namespace orb::assembler {

/// A rewrite from other assemblers, JSON, YAML or calls to macro source.
struct Rewrite {
  std::string_view does;
  void (*apply)(repair::Tokens& line);
  std::string_view before; ///< an example, which is also its test
  std::string_view after;
};

/// In the order of application.
std::span<const Rewrite> rewrites();

} // namespace orb::assembler
