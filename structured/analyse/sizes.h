#pragma once

#include "structured/lower/code.h"

#include <cstdint>

namespace orb::structured {

// Estimated sizes in bytes. They only choose between two correct programs.
inline constexpr std::uint32_t line_bytes = 5;   ///< its number, the space and the line ending
inline constexpr std::uint32_t call_bytes = 10;  ///< `12 gosub 34`
inline constexpr std::uint32_t jump_bytes = 10;  ///< `12 goto 34`
inline constexpr std::uint32_t return_bytes = 9; ///< `12 return`

std::uint32_t bytes_of(const Code& code, const CodeLine& line);

/// True if a line with an effect may be placed after `then` and `else`.
bool fits_arm(const CodeLine& line);

/// A separate copy of a line: facts about the copy must not apply to the original.
CodeLine copy_line(Code& code, CodeLine line);

} // namespace orb::structured
