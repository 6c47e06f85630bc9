#pragma once

// Private to assembler/: edits of whole lines.

#include "base/diagnostic.h"
#include "base/source.h"
#include "base/text/text.h"

#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <string_view>

namespace orb::assembler {

inline std::string_view indent_of(const Source& source, std::uint32_t line) {
  const auto text = source.line(line);
  return text.substr(0, std::min(text.find_first_not_of(" \t"), text.size()));
}

/// Inserts a statement as a new line below another.
inline Edit below(const Source& source, std::uint32_t line, std::string_view indent,
                  std::string_view statement) {
  const auto end = source.line_span(line).end;
  return {{end, end}, fmt::format("{}{}{}", line_end_of(source.text()), indent, statement)};
}

/// Inserts a statement as a new line above another, with the same indentation.
inline Edit above(const Source& source, std::uint32_t line, std::string_view statement) {
  const auto begin = source.line_start(line);
  return {{begin, begin},
          fmt::format("{}{}{}", indent_of(source, line), statement, line_end_of(source.text()))};
}

inline Edit without_line(const Source& source, std::uint32_t line) {
  return {{source.line_start(line), source.line_start(line + 1)}, {}};
}

} // namespace orb::assembler
