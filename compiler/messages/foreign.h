#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace orb::compiler {

/// A word or sign of another language: a row of compiler/messages/foreign.def.
struct Foreign {
  enum class Place : std::uint8_t { Statement, Value };

  std::string_view spelling; ///< in small letters
  Place place;
  std::string_view instead; ///< what takes its place; `-` nothing, `--` not even
                            ///< its line, empty where a person must write
  std::string_view help;
};

/// All rows.
std::span<const Foreign> foreign_words();

/// The row of a word or sign in that place, without regard to case, or null.
const Foreign* find_foreign(std::string_view spelling, Foreign::Place place);

} // namespace orb::compiler
