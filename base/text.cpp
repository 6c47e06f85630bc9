#include "base/text.h"

#include "base/utf8.h"

#include <fmt/format.h>

namespace orb {

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
    case '\n': out += "&#10;"; break; // a line end of an attribute would be read as a blank
    default: out += static_cast<unsigned char>(c) < ' ' && c != '\t' ? '?' : c;
    }
  for (const std::string_view forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) // U+FFFE, U+FFFF
    for (auto at = out.find(forbidden); at != std::string::npos; at = out.find(forbidden, at))
      out.replace(at, forbidden.size(), "\xEF\xBF\xBD");
  return out;
}

} // namespace orb
