#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace orb::assembler {

/// The canonical layout of macro source: directives at the margin, commands of a macro and bodies
/// of loops indented, one blank between operands, remarks kept, blank lines at most one in a row,
/// LF. Total: any bytes will do. The result assembles to the same bytes, and laying it out again
/// changes nothing.
std::string layout(std::string_view text);

/// Where the remark of a line begins, at `#` or `;`; the line's size where it has none.
std::size_t remark_of(std::string_view line);

} // namespace orb::assembler
