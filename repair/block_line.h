#pragma once

#include "repair/tokens.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace orb::repair {

/// The role of a line in a block, by the words of structured programs.
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
  Stop, ///< `end`, which ends the program, or a block if nothing else does
};

/// A line of a numbered program that is written in blocks.
struct BlockLine {
  std::uint32_t line = 0; ///< of the source
  std::uint32_t number = 0;
  std::size_t indent = 0; ///< spaces after the number
  std::string comment;
  Role role = Role::None;
  Tokens operand;        ///< a condition, a count, `I = 1 to 3`
  std::string_view ends; ///< for an End: the word of the block; empty: any
  bool colon = false;    ///< ends with a `:`
  std::string text;      ///< the replacement, without its number
  bool changed = false;  ///< `text` is valid
  std::string below;     ///< a line to add below
  bool gone() const { return changed && text.empty(); }
};

/// An end or a part of a block, with the block it belongs to.
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
