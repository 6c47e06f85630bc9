#pragma once

#include "base/diagnostic.h"
#include "structured/text/program.h"

#include <cstdint>
#include <optional>
#include <string_view>

// Words and signs of other languages: a table. The parser goes on as if those that begin or end a
// line were ours; the others are only named.

namespace orb::structured {

enum class Stands : std::uint8_t {
  First,  ///< as the first words of a statement
  Named,  ///< the same, but what is meant by it is left to repair/
  Last,   ///< at the end of a line
  Inside, ///< where a value, or a sign between values, is to stand
  Remark, ///< before a remark
};

struct Foreign {
  Stands stands;
  std::string_view words; ///< any of these, in small letters
  std::string_view after; ///< with any of these after it; empty: whatever follows
  std::string_view here;  ///< what is written instead; empty: nothing
  std::string_view languages;
  const orb::Text* help = nullptr; ///< where a line has to be thought of
};

/// What ends the innermost block, in Foreign::here.
inline constexpr std::string_view block_end = "end …";

const Foreign* find_foreign(Stands stands, std::string_view word, std::string_view after = {});

/// The finding about it; with a fix where `here` can take its place.
Diagnostic foreign(const Program& program, Span found, std::string_view languages,
                   std::string_view here);

/// A word or sign at which a line stops to parse, or which nothing defines: nothing where it is
/// none that is known.
std::optional<Diagnostic> name_foreign(const Program& program, Span found, Stands stands);

} // namespace orb::structured
