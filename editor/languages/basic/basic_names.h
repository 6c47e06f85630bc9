#pragma once

// Names in an orbBasic program: line numbers and letters.

#include "compiler/text/program.h"
#include "spec/limits.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

inline constexpr std::string_view basic_language_id = "orbbasic";
inline constexpr auto most_line_number =
    static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber));

/// A place of a line number: at its line, or as the target of a jump.
struct LineName {
  std::uint32_t number = 0;
  Span span;
  bool is_target = false;
  bool calls = false; ///< a target of gosub
};

std::vector<LineName> line_names(const compiler::Program& program);

/// `Z` is an array element, not a variable.
inline constexpr std::uint8_t indexed_letter = 'Z' - 'A';

struct LetterName {
  std::uint8_t letter = 0; ///< 0 for A to 25 for Z
  Span span;
  bool is_set = false;
};

/// Returns them in order of the text.
std::vector<LetterName> letter_names(const compiler::Program& program);

/// A line that something jumps to; for a subroutine, all lines to its end.
struct BasicPart {
  std::size_t first = 0; ///< indices into Program::lines
  std::size_t last = 0;
  bool is_called = false; ///< by gosub
  std::string title;      ///< its number and the comment above
};

/// Returns parts in order of the text; of lines with equal numbers only the first, which jumps
/// reach.
std::vector<BasicPart> parts_of(const compiler::Program& program);

} // namespace orb::editor
