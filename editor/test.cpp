// What an editor may ask about a test file.

#include "base/text.h"
#include "editor/language.h"
#include "editor/markdown.h"
#include "editor/text.h"
#include "reference/sections.h"
#include "spec/basic.h"
#include "testing/suite.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

constexpr std::string_view language_id = "orbtest";

std::vector<Diagnostic> check(const Source& source, const LanguageOptions& options) {
  structured::NoFiles none;
  // What it names counts from its folder.
  const Source named(path_of_uri(source.name()), std::string(source.text()));
  return testing::check(named, options.files != nullptr ? *options.files : none);
}

/// A word of a line and what stands before it.
struct Spot {
  Span span;
  std::string_view word;
  std::vector<std::string_view> before;
};

bool is_word_part(char c) {
  return is_letter(c) || is_digit(c) || c == '_';
}

/// The word at `offset`, which may be in the middle of it.
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

bool asks_what(const Spot& spot) {
  return spot.before.size() == 1 && (spot.before[0] == "expect" || spot.before[0] == "never");
}

std::optional<Hover> hover(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto spot = spot_at(source, offset);
  const auto found = [&](const reference::Section& section) -> std::optional<Hover> {
    auto text = find_markdown(section, spot.word, language_id);
    return text ? std::optional(Hover{spot.span, *std::move(text)}) : std::nullopt;
  };
  if (asks_what(spot))
    return found(reference::expectations_section());
  if (auto line = found(reference::test_lines_section()))
    return line;
  const bool stimulus = spot.before.empty() || spot.before[0] == "at";
  return stimulus ? found(reference::stimulus_section()) : std::nullopt;
}

/// The words of a table, with what each is.
template <class Rows>
void suggest_rows(Suggestions& out, const Rows& rows, const reference::Section& section) {
  for (const auto& row : rows)
    for (const auto& entry : section.entries)
      if (entry.name == row.word)
        out.items.push_back({std::string(row.word), SuggestionKind::Keyword,
                             std::string(row.operands),
                             entry_markdown(section, entry, language_id)});
}

Suggestions suggest(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto spot = spot_at(source, offset);
  Suggestions out;
  out.replaces = {spot.span.begin, offset};
  if (spot.before.empty()) {
    suggest_rows(out, testing::line_words, reference::test_lines_section());
    suggest_rows(out, vm::stimulus_words, reference::stimulus_section());
  } else if (asks_what(spot)) {
    suggest_rows(out, testing::expectations, reference::expectations_section());
  } else if (spot.before[0] == "at" && spot.before.size() == 2) {
    suggest_rows(out, vm::stimulus_words, reference::stimulus_section());
  } else if (spot.before.back() == "color") {
    for (const auto& row : spec::led_colours)
      out.items.push_back({std::string(row.name), SuggestionKind::Value, "", ""});
  } else if (spot.before[0] == "expect" || spot.before[0] == "never" || spot.before[0] == "reach") {
    suggest_rows(out, testing::when_words, reference::test_lines_section());
  }
  return out;
}

std::vector<Symbol> outline(const Source& source) {
  std::vector<Symbol> symbols;
  const auto file = testing::parse(source);
  const auto size = static_cast<std::uint32_t>(source.text().size());
  for (std::size_t i = 0; i < file.tests.size(); ++i) {
    const auto& test = file.tests[i];
    if (test.name.span.size() == 0)
      continue;
    const auto end = i + 1 < file.tests.size() ? source.line_start(file.tests[i + 1].line) : size;
    symbols.push_back({test.name.text,
                       plural(test.points, "point"),
                       {source.line_start(test.line), std::max(end, test.name.span.end)},
                       test.name.span});
  }
  return symbols;
}

Occurrences occurrences(const Source&, std::uint32_t, const LanguageOptions&) {
  return {};
}

tl::expected<Renaming, std::string> rename(const Source&, std::uint32_t, std::string_view,
                                           const LanguageOptions&) {
  return tl::unexpected(std::string("nothing in a test file can be renamed"));
}

std::optional<std::string> format(const Source&) {
  return std::nullopt;
}

std::vector<Rewrite> rewrites(const Source&, const LanguageOptions&) {
  return {};
}

} // namespace

const LanguageService test_service = {check,       hover,  suggest, outline,
                                      occurrences, rename, format,  rewrites};

} // namespace orb::editor
