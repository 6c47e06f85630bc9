#pragma once

#include "base/diagnostic.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// A text after some fixes.
struct Fixed {
  std::string text;
  std::size_t count = 0; ///< fixes made
};

/// Makes the safe fixes among `diagnostics` that do not touch each other; of two that do, the first
/// in the list wins.
Fixed apply_fixes(std::string_view text, const std::vector<Diagnostic>& diagnostics);

} // namespace orb
