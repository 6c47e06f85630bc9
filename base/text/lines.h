#pragma once

#include <algorithm>
#include <string_view>

namespace orb {

/// Removes the first line of a text, with its ending (LF, CR or CRLF), and returns it without that.
constexpr std::string_view take_line(std::string_view& text) {
  const auto end = std::min(text.find_first_of("\r\n"), text.size());
  const auto line = text.substr(0, end);
  text.remove_prefix(end);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
  return line;
}

} // namespace orb
