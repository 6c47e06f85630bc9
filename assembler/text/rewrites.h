#pragma once

// Private to assembler/.

#include "repair/tokens.h"

#include <span>
#include <string_view>

namespace orb::assembler {

/// A way to write lines in other assemblers, JSON, YAML and calls, which becomes that of macros.
struct Rewrite {
  std::string_view does;
  void (*apply)(repair::Tokens& line);
  std::string_view before; ///< an example, which is its test
  std::string_view after;
};

/// In the order in which they are applied.
std::span<const Rewrite> rewrites();

} // namespace orb::assembler
