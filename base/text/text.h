#pragma once

// Characters and words of ASCII, the same in every locale.

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
/// Whether a byte continues a character of UTF-8.
constexpr bool is_utf8_tail(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Whether two words have the same letters, in capitals or not.
constexpr bool equal_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return to_lower(x) == to_lower(y); });
}

/// Whether a file's name ends so, in capitals or not: `ROBOT.ORB` is a `.orb`, too.
constexpr bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         equal_words(name.substr(name.size() - ending.size()), ending);
}

/// In small letters; bytes beyond ASCII stay.
std::string lower(std::string_view text);

/// Whether `word` is one of `words`, which have a blank between them; case does not count.
bool holds(std::string_view words, std::string_view word);

/// The words of a text that has one blank between two of them.
std::vector<std::string_view> words_in(std::string_view text);

/// How the lines of a text end: as its first one does, else with LF.
constexpr std::string_view line_end_of(std::string_view text) {
  const auto at = text.find_first_of("\r\n");
  if (at == std::string_view::npos)
    return "\n";
  return text.substr(at, text.substr(at).starts_with("\r\n") ? 2 : 1);
}

/// `text` without the blanks at its ends.
constexpr std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// `1 byte`, `2 bytes`: a count and its noun, whose plural ends in an s.
std::string plural(std::uint64_t count, std::string_view noun);

/// `text` as a text or an attribute of HTML, SVG and XML: valid UTF-8, without the characters that
/// XML 1.0 forbids.
std::string escape_markup(std::string_view text);

/// parse_number() for numbers with a point and, unless `form` is fixed, an exponent.
std::optional<double> parse_real(std::string_view text,
                                 std::chars_format form = std::chars_format::general);

/// The number that all of `text` is, in the form of std::from_chars: no sign `+`, no blanks.
/// `form` is the base of a whole number, or a std::chars_format. Nothing where it does not fit.
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
