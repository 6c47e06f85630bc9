#include "editor/languages/test/test_names.h"

#include "base/text/text.h"

namespace orb::editor {
namespace {

bool is_word_part(char c) {
  return is_letter(c) || is_digit(c) || c == '_' || c == '-';
}

} // namespace

Spot spot_at(const Source& source, std::uint32_t offset) {
  const auto line = source.position(offset).line;
  const auto text = source.line(line);
  const auto start = source.line_start(line);
  const auto at = std::min<std::size_t>(offset - start, text.size());
  auto begin = at;
  while (begin > 0 && is_word_part(text[begin - 1]))
    --begin;
  auto end = at;
  while (end < text.size() && is_word_part(text[end]))
    ++end;
  Spot spot{{start + static_cast<std::uint32_t>(begin), start + static_cast<std::uint32_t>(end)},
            text.substr(begin, end - begin),
            {}};
  for (std::size_t i = 0; i < begin;) {
    const auto next = std::min(text.find_first_of(" \t", i), begin);
    if (next > i)
      spot.before.push_back(text.substr(i, next - i));
    i = next + 1;
  }
  return spot;
}

bool is_stimulus_place(const Spot& spot) {
  return spot.before.empty() || (spot.before[0] == "at" && spot.before.size() == 2);
}

std::vector<Span> tokens_around(const Source& source, std::uint32_t offset) {
  std::vector<Span> spans;
  for (const auto& token : tokens_at(source, offset, test_lexis))
    spans.push_back(token.span);
  return spans;
}

} // namespace orb::editor
