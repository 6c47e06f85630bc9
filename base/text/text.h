#pragma once

// ASCII characters and words, independent of the locale.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace orb {

constexpr bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
constexpr char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
constexpr char to_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
/// True if the byte continues a UTF-8 sequence.
constexpr bool is_utf8_tail(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// True if two words are equal, ignoring case.
constexpr bool equal_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return to_lower(x) == to_lower(y); });
}

/// True if the file name has this extension, ignoring case: `ROBOT.ORB` is a `.orb`.
constexpr bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         equal_words(name.substr(name.size() - ending.size()), ending);
}

/// Converts to lower case; bytes beyond ASCII stay.
std::string lower(std::string_view text);

/// True if `word` is one of the space-separated `words`, ignoring case.
bool holds(std::string_view words, std::string_view word);

/// Splits at single spaces.
std::vector<std::string_view> words_in(std::string_view text);

/// The line ending of a text: that of its first line, else LF.
constexpr std::string_view line_end_of(std::string_view text) {
  const auto at = text.find_first_of("\r\n");
  if (at == std::string_view::npos)
    return "\n";
  return text.substr(at, text.substr(at).starts_with("\r\n") ? 2 : 1);
}

/// Removes whitespace at both ends.
constexpr std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// A count and its noun: `1 byte`, `2 bytes`. The plural must end in an s.
std::string plural(std::uint64_t count, std::string_view noun);

/// Escapes `text` for content or attributes of HTML, SVG and XML: valid UTF-8, without the
/// characters that XML 1.0 forbids.
std::string escape_markup(std::string_view text);

/// parse_number() for numbers with a point and, unless `form` is fixed, an exponent.
std::optional<double> parse_real(std::string_view text,
                                 std::chars_format form = std::chars_format::general);

/// Parses all of `text` as a number, as std::from_chars does: no `+` sign, no whitespace. `form` is
/// the base of a whole number, or a std::chars_format. Returns nothing if it does not fit.
template <typename Number, typename... Form>
std::optional<Number> parse_number(std::string_view text, Form... form) {
  if constexpr (std::is_floating_point_v<Number>) {
    return parse_real(text, form...);
  } else {
    Number number{};
    const auto* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number, form...);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
  }
}

} // namespace orb
