#pragma once

#include "base/diagnostic.h"
#include "repair/tokens.h"
#include "spec/limits.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

// The line to write: what a line with an error was meant to be. Known habits first
// (repair/idioms.def), then the nearest line by a bounded search over small changes. Every offer
// was tried: the whole text was checked with it.

namespace orb::repair {

/// Of orbBasic.
inline constexpr auto greatest_line_number =
    static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber));

/// A line that says the same in another form.
struct Rephrased {
  std::string text;       ///< without the blanks in front; several lines have `\n` between them
  bool sure = true;       ///< nothing else can have been meant
  std::string other = {}; ///< what can have been meant as well; empty without one
};

/// What a language answers about texts.
struct Dialect {
  Language language = Language::Basic;
  std::vector<std::string_view> words; ///< of the language, in their documented spelling
  /// Whether a line parses by itself, as far as one line can tell.
  std::function<bool(std::string_view line)> parses;
  /// What the values of a line say, in the documented order and form, the likeliest first; may be
  /// empty.
  std::function<std::vector<Rephrased>(const Tokens& line)> rephrase = {};
  /// All findings about a whole text.
  std::function<std::vector<Diagnostic>(std::string_view text)> check;
};

/// Gives the first error of each line the line to write, as help and as a fix, where one is clear.
/// What those lines mend elsewhere, too, is told no longer. Bounded: long texts, long lines and all
/// but the first lines with errors stay as they are.
void offer_lines(std::string_view text, const Dialect& dialect, std::vector<Diagnostic>& findings);

} // namespace orb::repair
