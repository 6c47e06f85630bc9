#include "editor/text_places.h"

#include "base/path.h"
#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <string_view>

namespace orb::editor {
namespace {

/// How many units of `encoding` a code point of `length` UTF-8 bytes takes.
std::uint32_t units(std::size_t length, PositionEncoding encoding) {
  switch (encoding) {
  case PositionEncoding::Utf8: return static_cast<std::uint32_t>(length);
  case PositionEncoding::Utf16: return length == 4 ? 2 : 1; // beyond U+FFFF: a surrogate pair
  case PositionEncoding::Utf32: break;
  }
  return 1;
}

} // namespace

std::uint32_t offset_of(const Source& source, TextPosition position, PositionEncoding encoding) {
  if (position.line >= source.line_count())
    return static_cast<std::uint32_t>(source.text().size());
  const auto line = source.line(position.line + 1);
  const auto start = source.line_start(position.line + 1);
  std::uint32_t at = 0;
  std::uint32_t left = position.character;
  while (at < line.size()) {
    const auto length = std::max<std::size_t>(1, utf8_length(line.substr(at)));
    const auto width = units(length, encoding);
    if (left < width)
      break;
    left -= width;
    at += static_cast<std::uint32_t>(length);
  }
  return start + at;
}

TextPosition Ruler::operator()(std::uint32_t offset) {
  const auto place = source_->position(offset);
  const auto line = source_->line(place.line);
  const auto end = std::min<std::size_t>(place.column - 1, line.size());
  if (last_.line != place.line - 1 || at_ > end) {
    last_ = {place.line - 1, 0};
    at_ = 0;
  }
  while (at_ < end) {
    const auto length = std::max<std::size_t>(1, utf8_length(line.substr(at_)));
    if (at_ + length > end)
      break;
    last_.character += units(length, encoding_);
    at_ += length;
  }
  return last_;
}

std::string path_of_uri(std::string_view uri) {
  constexpr std::string_view scheme = "file://";
  if (!uri.starts_with(scheme))
    return std::string(uri);
  uri.remove_prefix(scheme.size());
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned byte = 0;
    const auto digits = uri.substr(i + 1, 2);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    const bool is_code = uri[i] == '%' && digits.size() == 2 && read.ptr == digits.data() + 2;
    path += is_code ? static_cast<char>(byte) : uri[i];
    i += is_code ? 2 : 0;
  }
  if (path.starts_with('/') && has_drive(std::string_view(path).substr(1)))
    path.erase(0, 1);
  return path;
}

std::string uri_of_path(std::string_view path) {
  if (!is_absolute_path(path))
    return std::string(path);
  std::string uri = has_drive(path) ? "file:///" : "file://";
  for (const char c : path) {
    const bool plain =
        is_letter(c) || is_digit(c) || std::string_view("/-._~").find(c) != path.npos;
    if (plain)
      uri += c;
    else
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

} // namespace orb::editor
