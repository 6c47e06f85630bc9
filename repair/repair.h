#pragma once

#include "base/diagnostic.h"
#include "repair/tokens.h"
#include "spec/limits.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

// Proposes the line that an erroneous line was meant to be: first by known idioms
// (repair/idioms.def), then by a bounded search over small changes. Every proposal was verified:
// the whole text was checked with it.

namespace orb::repair {

/// The limit of orbBasic.
inline constexpr auto greatest_line_number =
    static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber));

/// A line that says the same in another form.
struct Rephrased {
  std::string text;       ///< without leading spaces; several lines are separated by `\n`
  bool sure = true;       ///< no other meaning is possible
  std::string other = {}; ///< another possible meaning; empty: none
};

/// The interface of a language to repair.
struct Dialect {
  Language language = Language::Basic;
  std::vector<std::string_view> words; ///< of the language, in their documented spelling
  /// True if a line parses on its own, as far as one line can tell.
  std::function<bool(std::string_view line)> parses;
  /// Rewrites the values of a line in their documented order and form, the likeliest first; may be
  /// empty.
  std::function<std::vector<Rephrased>(const Tokens& line)> rephrase = {};
  /// Returns all findings about a whole text.
  std::function<std::vector<Diagnostic>(std::string_view text)> check;
};

/// Adds a replacement, as help and as a fix, to the first error of each line where one is clear.
/// Removes errors that these lines also repair elsewhere. Bounded: long texts, long lines and all
/// but the first lines with errors stay unchanged.
void offer_lines(std::string_view text, const Dialect& dialect, std::vector<Diagnostic>& findings);

} // namespace orb::repair
