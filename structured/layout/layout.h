#pragma once

#include "structured/text/program.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// A line of a text in canonical layout.
struct LaidLine {
  Span source;            ///< the line in Program::text, without its end
  std::string text;       ///< without indent
  std::size_t code = 0;   ///< the bytes of `text` before its comment
  std::size_t level = 0;  ///< of its indent
  std::size_t around = 0; ///< the level of what stands after it
  bool after_blank = false;
  std::uint32_t statements_begin = 0; ///< those that begin in it
  std::uint32_t statements_end = 0;
};

/// The lines of a program's first file that are not blank; the program has been parsed, no more.
std::vector<LaidLine> lay_out(const Program& program);

/// A name as the program writes it first.
std::string_view first_spelling(const Program& program, std::string_view name);

/// A word in its documented spelling; the former name of a variable is another word.
std::string_view documented(std::string_view word);

} // namespace orb::structured
