#include "base/text/text.h"

#include "base/text/utf8.h"

#include <fmt/format.h>

#ifndef __cpp_lib_to_chars // missing in the browser's build
#include <cerrno>
#include <cstdlib>
#endif

namespace orb {
namespace {

/// Consumes the digits at the front; returns true if there were any.
bool take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  const auto count = static_cast<std::size_t>(end - text.begin());
  text.remove_prefix(count);
  return count > 0;
}

bool take(std::string_view& text, std::string_view any_of) {
  const bool taken = !text.empty() && any_of.find(text.front()) != std::string_view::npos;
  text.remove_prefix(taken ? 1 : 0);
  return taken;
}

/// True if `text` has the form `-1.5e-3` or a part of it. Excludes `inf` and hexadecimal digits.
bool is_real(std::string_view text, std::chars_format form) {
  take(text, "-");
  bool digits = take_digits(text);
  if (take(text, "."))
    digits = take_digits(text) || digits;
  if (digits && form != std::chars_format::fixed && take(text, "eE")) {
    take(text, "+-");
    digits = take_digits(text);
  }
  return digits && text.empty();
}

} // namespace

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), to_lower);
  return small;
}

bool holds(std::string_view words, std::string_view word) {
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find(' ', at), words.size());
    if (equal_words(words.substr(at, end - at), word))
      return true;
    at = end + 1;
  }
  return false;
}

std::vector<std::string_view> words_in(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

std::optional<double> parse_real(std::string_view text, std::chars_format form) {
  if (!is_real(text, form))
    return std::nullopt;
  double number = 0;
#ifdef __cpp_lib_to_chars
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number, form);
  const bool fits = read.ec == std::errc{};
#else
  errno = 0;
  number = std::strtod(std::string(text).c_str(), nullptr);
  const bool fits = errno == 0;
#endif
  return fits ? std::optional(number) : std::nullopt;
}

std::string plural(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string escape_markup(std::string_view text) {
  std::string out;
  for (const char c : to_valid_utf8(text))
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += "&quot;"; break;
    case '\n': out += "&#10;"; break; // XML would read a line ending in an attribute as a space
    default: out += static_cast<unsigned char>(c) < ' ' && c != '\t' ? '?' : c;
    }
  for (const std::string_view forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) // U+FFFE, U+FFFF
    for (auto at = out.find(forbidden); at != std::string::npos; at = out.find(forbidden, at))
      out.replace(at, forbidden.size(), "\xEF\xBF\xBD");
  return out;
}

} // namespace orb
