#pragma once

#include "structured/text/program.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// A line of a text in canonical layout.
struct LaidLine {
  Span source;            ///< the line in Program::text, without its line ending
  std::string text;       ///< without indentation
  std::size_t code = 0;   ///< the bytes of `text` before its comment
  std::size_t level = 0;  ///< of its indentation
  std::size_t around = 0; ///< the level of the next line
  bool after_blank = false;
  std::uint32_t statements_begin = 0; ///< those that begin in it
  std::uint32_t statements_end = 0;
};

/// Lays out the lines of a program's first file that are not blank. The program only needs to be
/// parsed.
std::vector<LaidLine> lay_out(const Program& program);

/// The first spelling of a name in the program.
std::string_view first_spelling(const Program& program, std::string_view name);

/// The documented spelling of a word. A former name of a variable counts as another word.
std::string_view documented(std::string_view word);

} // namespace orb::structured
