#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace orb {

/// The length in bytes of the code point at the front of `text`: 1 to 4, or 0 where the bytes are
/// not UTF-8 (then one byte stands for one U+FFFD). `text` is not empty.
std::size_t utf8_length(std::string_view text);

/// The bytes of the byte order mark that editors on Windows put before a text; 0 where there is
/// none.
constexpr std::size_t byte_order_mark_size(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? mark.size() : 0;
}

/// By byte: whether it has no place in a text, as a control character that is no tab or line end.
inline constexpr auto is_binary_byte = [] {
  std::array<bool, UINT8_MAX + 1> table{};
  for (std::size_t c = 0; c < ' '; ++c)
    table[c] = c != '\t' && c != '\n' && c != '\r';
  table['\x7F'] = true;
  return table;
}();

/// How many code points `text` shows, a byte that is not UTF-8 counting as one (U+FFFD).
std::size_t code_points(std::string_view text);

/// `text` as valid UTF-8: each byte that is not becomes U+FFFD.
std::string to_valid_utf8(std::string_view text);

/// Bytes that count as U+0000 to U+00FF, as UTF-8: what a robot prints is of no encoding.
std::string from_latin1(std::string_view bytes);

/// `text` fit for a terminal: valid UTF-8, control characters replaced by a blank (tab) or U+FFFD,
/// so that every code point takes one column and no escape sequence gets through.
std::string to_printable(std::string_view text);

/// A file's name as lines of output begin with it: control characters as `\n` or `\x1B`, so that it
/// stays on its line; `./` before a name that begins with `::`, which would be a command to the
/// runners of GitHub.
std::string shown_name(std::string_view name);

/// `text` as it may be written to a terminal: as to_printable(), but line ends and tabs stay, and
/// so do the colours and the clearing of a line that our own output is made of.
std::string to_terminal_text(std::string_view text);

} // namespace orb
