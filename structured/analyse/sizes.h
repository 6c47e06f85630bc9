#pragma once

#include "structured/lower/code.h"

#include <cstdint>

namespace orb::structured {

// Rough sizes in bytes: they only choose between two right programs.
inline constexpr std::uint32_t line_bytes = 5;   ///< its number, the blank and the line end
inline constexpr std::uint32_t call_bytes = 10;  ///< `12 gosub 34`
inline constexpr std::uint32_t jump_bytes = 10;  ///< `12 goto 34`
inline constexpr std::uint32_t return_bytes = 9; ///< `12 return`

std::uint32_t bytes_of(const Code& code, const CodeLine& line);

/// Whether a line that does something may stand after `then` and `else`.
bool fits_arm(const CodeLine& line);

/// A line of its own with what another one does: what is found out about the copy must not be
/// believed of the other.
CodeLine copy_line(Code& code, CodeLine line);

} // namespace orb::structured
