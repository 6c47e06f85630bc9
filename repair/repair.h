#pragma once

#include "base/diagnostic.h"
#include "repair/tokens.h"

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

// The line to write: what a line with an error was meant to be. Known habits first
// (repair/idioms.def), then the nearest line by a bounded search over small changes. Every offer
// was tried: the whole text was checked with it.

namespace orb::repair {

/// Of orbBasic, which stands below this room: compiler/check.cpp holds it against spec/.
inline constexpr std::uint32_t greatest_line_number = 65535;

/// What a language answers about texts.
struct Judge {
  Language language = Language::Basic;
  std::vector<std::string_view> words; ///< of the language, in their documented spelling
  /// Whether a line parses by itself, as far as one line can tell.
  std::function<bool(std::string_view line)> parses;
  /// All findings about a whole text.
  std::function<std::vector<Diagnostic>(std::string_view text)> check;
};

/// Gives the first error of each line the line to write, as help and as a fix, where one is clear.
/// What those lines mend elsewhere, too, is told no longer. Bounded: long texts, long lines and all
/// but the first lines with errors stay as they are.
void offer_lines(std::string_view text, const Judge& judge, std::vector<Diagnostic>& findings);

} // namespace orb::repair
