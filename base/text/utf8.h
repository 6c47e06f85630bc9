#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace orb {

/// The length in bytes, 1 to 4, of the code point at the front of `text`; 0 if the bytes are not
/// UTF-8, and then one byte becomes one U+FFFD. `text` must not be empty.
std::size_t utf8_length(std::string_view text);

/// The size of the byte order mark that Windows editors put before a text; 0 if there is none.
constexpr std::size_t byte_order_mark_size(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? mark.size() : 0;
}

/// For each byte: true if it does not belong in a text, that is, a control character other than tab
/// and line endings.
inline constexpr auto is_binary_byte = [] {
  std::array<bool, UINT8_MAX + 1> table{};
  for (std::size_t c = 0; c < ' '; ++c)
    table[c] = c != '\t' && c != '\n' && c != '\r';
  table['\x7F'] = true;
  return table;
}();

/// The number of code points in `text`. A byte that is not UTF-8 counts as one (U+FFFD).
std::size_t code_points(std::string_view text);

/// Converts `text` to valid UTF-8: each invalid byte becomes U+FFFD.
std::string to_valid_utf8(std::string_view text);

/// Converts bytes to UTF-8 as U+0000 to U+00FF. The output of a robot has no encoding.
std::string from_latin1(std::string_view bytes);

/// Makes `text` safe for one terminal line: valid UTF-8, tabs become a space and other control
/// characters U+FFFD, so that every code point takes one column and no escape sequence gets
/// through.
std::string to_printable(std::string_view text);

/// Escapes a file name for the start of an output line: control characters become `\n` or `\x1B`,
/// to keep it on one line; `./` goes before a name that begins with `::`, which GitHub runners
/// would read as a command.
std::string shown_name(std::string_view name);

/// Makes `text` safe for a terminal as to_printable() does, but keeps line endings, tabs, and the
/// escape sequences that orb itself prints (colours, clear the line).
std::string to_terminal_text(std::string_view text);

} // namespace orb
