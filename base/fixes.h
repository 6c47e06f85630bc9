#pragma once

#include "base/diagnostic.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// A fix of one edit.
Fix single_fix(Message title, Span span, std::string text, Safety safety = Safety::Safe);

/// A text after fixing.
struct Fixed {
  std::string text;
  std::size_t count = 0; ///< fixes applied
};

/// Applies the fixes; if two touch each other, the first wins.
Fixed apply_fixes(std::string_view text, const std::vector<Diagnostic>& diagnostics);

/// Adds the fixed line as help to each finding that has a fix within its line and no help yet.
void say_lines(std::string_view text, std::vector<Diagnostic>& diagnostics);

/// Returns all findings about a text.
using Check = std::function<std::vector<Diagnostic>(std::string_view text)>;

/// Applies the safe fixes until none is left, so that fixing the result changes nothing. Each fix
/// is tried first and withheld if it adds an error of another kind elsewhere, or gains nothing. The
/// fixes of a round are tried together; if they conflict, one by one, each on the result of those
/// before.
Fixed fix_all(std::string text, const Check& check);

/// The same, with a faster check `judge` that decides whether a fix helped.
Fixed fix_all(std::string text, const Check& check, const Check& judge);

} // namespace orb
