#pragma once

#include "repair/tokens.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace orb::repair {

/// What a line is to a block, by the words that structured programs have for it.
enum class Role : std::uint8_t {
  None,
  If,
  ElseIf,
  Else,
  While,
  Loop,
  Repeat, ///< a number of times
  For,
  Until,
  Exit,
  Continue,
  End,
  Stop, ///< `end`, which ends the program and, where nothing else does, a block
};

/// A line of a numbered program that is written in blocks.
struct BlockLine {
  std::uint32_t line = 0; ///< of the source
  std::uint32_t number = 0;
  std::size_t indent = 0; ///< blanks after the number
  std::string comment;
  Role role = Role::None;
  Tokens operand;        ///< a condition, a number of times, `I = 1 to 3`
  std::string_view ends; ///< of an End: the word of the block; empty: of any
  bool colon = false;    ///< it was written with a `:` at its end
  std::string text;      ///< what becomes of it, without its number
  bool changed = false;  ///< `text` counts
  std::string below;     ///< a line that is added
  bool gone() const { return changed && text.empty(); }
};

/// An end or a part of a block, and which block it ends.
struct BlockWord {
  std::string_view form;
  Role role;
  std::string_view ends;
};
inline constexpr BlockWord block_words[] = {
    {"end if", Role::End, "if"},      {"end while", Role::End, "while"},
    {"end loop", Role::End, "loop"},  {"end repeat", Role::End, "repeat"},
    {"else", Role::Else, ""},         {"exit", Role::Exit, ""},
    {"continue", Role::Continue, ""}, {"loop", Role::Loop, ""},
    {"repeat", Role::Loop, ""},       {"end", Role::Stop, ""},
};

} // namespace orb::repair
