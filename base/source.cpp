#include "base/source.h"

#include <algorithm>
#include <utility>

namespace orb {

std::string_view file_name(std::string_view path) {
  return path.substr(path.rfind('/') + 1); // npos + 1 is 0
}

std::string_view stem(std::string_view path) {
  const auto name = file_name(path);
  const auto dot = name.rfind('.');
  return dot == 0 ? name : name.substr(0, dot);
}

Source::Source(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)) {
  starts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const bool crlf = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
    if (text_[i] == '\n' || (text_[i] == '\r' && !crlf))
      starts_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

std::string_view Source::text(Span span) const {
  const auto size = static_cast<std::uint32_t>(text_.size());
  const auto begin = std::min(span.begin, size);
  return std::string_view(text_).substr(begin, std::min(span.end, size) - begin);
}

Position Source::position(std::uint32_t offset) const {
  offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const auto line = static_cast<std::uint32_t>(next - starts_.begin());
  return {line, offset - starts_[line - 1] + 1};
}

std::string_view Source::line(std::uint32_t line) const {
  if (line == 0 || line > line_count())
    return {};
  auto text =
      std::string_view(text_).substr(starts_[line - 1], line_start(line + 1) - starts_[line - 1]);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

std::uint32_t Source::line_start(std::uint32_t line) const {
  if (line == 0 || line > line_count())
    return static_cast<std::uint32_t>(text_.size());
  return starts_[line - 1];
}

Span Source::line_span(std::uint32_t line) const {
  const auto begin = line_start(line);
  return {begin, begin + static_cast<std::uint32_t>(this->line(line).size())};
}

} // namespace orb
