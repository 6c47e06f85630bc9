#pragma once

#include "base/diagnostic.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// A text after some fixes.
struct Fixed {
  std::string text;
  std::size_t count = 0; ///< fixes made
};

/// The text with these fixes made; of two that touch each other the first wins.
Fixed apply_fixes(std::string_view text, const std::vector<Diagnostic>& diagnostics);

/// A finding that has a fix within its line and says nothing of what helps says the line to write.
void say_lines(std::string_view text, std::vector<Diagnostic>& diagnostics);

/// All findings about a text.
using Check = std::function<std::vector<Diagnostic>(std::string_view text)>;

/// Makes the safe fixes, again and again until none is left: fixing the result changes nothing
/// more. Each fix is tried first, and withheld where an error of another kind would come to be
/// elsewhere, or nothing would be gained. All fixes of a round are tried together, and one by one,
/// on what the ones before it left, where they get in each other's way.
Fixed fix_all(std::string text, const Check& check);

/// The same where a quicker check is enough to judge what a fix has led to.
Fixed fix_all(std::string text, const Check& check, const Check& judge);

} // namespace orb
