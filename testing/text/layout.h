#pragma once

#include <string>
#include <string_view>

namespace orb::testing {

/// Formats a test file or a stimulus script: indents the lines of a test, and printed texts below
/// their expectation once more; puts one space between words, at most one blank line in a row and
/// one above a test; ends lines with LF. Keeps words and comments. Accepts any bytes. Formatting
/// the result again changes nothing.
std::string layout(std::string_view text);

} // namespace orb::testing
