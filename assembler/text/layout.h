#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace orb::assembler {

/// Formats macro source: directives at the margin, commands of a macro and bodies of loops
/// indented, one space between operands, remarks kept, at most one blank line in a row, LF. Accepts
/// any bytes. The result assembles to the same bytes; formatting it again changes nothing.
std::string layout(std::string_view text);

/// The start of the remark of a line, at `#` or `;`; the line's size if it has none.
std::size_t remark_of(std::string_view line);

} // namespace orb::assembler
