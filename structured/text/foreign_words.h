#pragma once

#include "base/diagnostic.h"
#include "structured/text/program.h"

#include <cstdint>
#include <optional>
#include <string_view>

// A table of words and signs of other languages. The parser treats those at the start or end of a
// line as their native equivalents; the others are only named in findings.

namespace orb::structured {

enum class Stands : std::uint8_t {
  First,  ///< as the first words of a statement
  Named,  ///< the same, but repair/ decides what is meant
  Last,   ///< at the end of a line
  Inside, ///< in place of a value, or of an operator between values
  Remark, ///< before a comment
};

struct Foreign {
  Stands stands;
  std::string_view words; ///< any of these, in lower case
  std::string_view after; ///< followed by any of these; empty: anything
  std::string_view here;  ///< the replacement; empty: nothing
  std::string_view languages;
  const orb::Text* help = nullptr; ///< if no replacement can be given
};

/// In Foreign::here, the end of the innermost block.
inline constexpr std::string_view block_end = "end …";

const Foreign* find_foreign(Stands stands, std::string_view word, std::string_view after = {});

/// Makes the finding; with a fix if `here` can replace the text.
Diagnostic foreign(const Program& program, Span found, std::string_view languages,
                   std::string_view here);

/// Names a foreign word or sign where a line stops parsing, or that is undefined; nothing if it is
/// unknown.
std::optional<Diagnostic> name_foreign(const Program& program, Span found, Stands stands);

} // namespace orb::structured
