#include "base/text/utf8.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// True if the code point at the front is printable, not a terminal control.
bool is_shown(std::string_view text) {
  const auto length = utf8_length(text);
  const auto lead = static_cast<unsigned char>(text.front());
  // C1 controls (U+0080 to U+009F) drive terminals just as C0 controls do.
  const bool c1 = length == 2 && lead == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
  return length > 0 && lead >= 0x20 && lead != 0x7F && !c1;
}

/// The length of a sequence `ESC [ digits m` (colour) or `ESC [ K` (clear the line) at the front,
/// else 0.
std::size_t own_sequence(std::string_view text) {
  if (!text.starts_with("\x1b["))
    return 0;
  const auto end = text.find_first_not_of("0123456789;", 2);
  if (end == std::string_view::npos || (text[end] != 'm' && (text[end] != 'K' || end != 2)))
    return 0;
  return end + 1;
}

} // namespace

std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80)
    return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length)
    return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!continues(text[i]))
      return 0;
  const auto second = static_cast<unsigned char>(text[1]);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool surrogate = lead == 0xED && second >= 0xA0;
  const bool too_high = lead == 0xF4 && second >= 0x90;
  return overlong || surrogate || too_high ? 0 : length;
}

std::size_t code_points(std::string_view text) {
  std::size_t count = 0;
  while (!text.empty()) {
    const auto length = utf8_length(text);
    text.remove_prefix(length == 0 ? 1 : length);
    ++count;
  }
  return count;
}

std::string to_valid_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto length = utf8_length(text);
    out += length == 0 ? replacement : text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string from_latin1(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xC0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return text;
}

std::string to_printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto length = std::max<std::size_t>(1, utf8_length(text));
    out += text.front() == '\t' ? " " : is_shown(text) ? text.substr(0, length) : replacement;
    text.remove_prefix(length);
  }
  return out;
}

std::string shown_name(std::string_view name) {
  std::string out;
  if (name.substr(std::min(name.size(), name.find_first_not_of(' '))).starts_with("::"))
    out = "./";
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == '\t')
      out += "\\t";
    else if (byte < ' ' || byte == 0x7F)
      out += fmt::format("\\x{:02X}", byte);
    else
      out += c;
  }
  return out;
}

std::string to_terminal_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto own = own_sequence(text);
    const auto length = std::max({std::size_t{1}, own, utf8_length(text)});
    const bool layout = std::string_view("\n\r\t").find(text.front()) != std::string_view::npos;
    out += own > 0 || layout || is_shown(text) ? text.substr(0, length) : replacement;
    text.remove_prefix(length);
  }
  return out;
}

} // namespace orb
