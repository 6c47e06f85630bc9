// Editor support for test files.

#include "base/text/text.h"
#include "editor/languages/test/test_names.h"
#include "editor/text_places.h"
#include "report/course.h"
#include "spec/basic.h"
#include "spec/colours.h"
#include "spec/firmware.h"
#include "testing/suite.h"
#include "testing/text/layout.h"

#include <fmt/format.h>

namespace orb::editor {
namespace {

std::vector<Diagnostic> check(const Source& source, const LanguageOptions& options) {
  structured::NoFiles none;
  // Names in it are relative to its folder.
  const Source named(path_of_uri(source.name()), std::string(source.text()));
  return testing::check(named, options.files != nullptr ? *options.files : none);
}

bool is_expectation(std::string_view word) {
  return word == "expect" || word == "never";
}

bool asks_what(const Spot& spot) {
  return spot.before.size() == 1 && is_expectation(spot.before[0]);
}

std::optional<Hover> hover(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto spot = spot_at(source, offset);
  const auto found = [&](const reference::Section& section) -> std::optional<Hover> {
    auto text = find_markdown(section, spot.word, test_language_id);
    return text ? std::optional(Hover{spot.span, *std::move(text)}) : std::nullopt;
  };
  if (asks_what(spot))
    return found(reference::expectations_section());
  if (auto line = found(reference::test_lines_section()))
    return line;
  return is_stimulus_place(spot) ? found(reference::stimulus_section()) : std::nullopt;
}

/// Suggests the zones of the file's course.
void suggest_zones(Suggestions& out, const Source& source, const LanguageOptions& options) {
  const auto file = testing::parse(source);
  if (!file.course || options.files == nullptr)
    return;
  const auto path = structured::resolve_path(path_of_uri(source.name()), file.course->text);
  auto drawing = options.files->read(path);
  if (!drawing)
    return;
  for (const auto& zone : report::read_course(Source(path, *std::move(drawing))).course.zones)
    out.items.push_back({zone.id, SuggestionKind::Name, "zone of " + file.course->text, ""});
}

/// The kind of value expected after the last word.
slot::Kind kind_behind(const Spot& spot) {
  const auto first = [](const auto* row) {
    return row == nullptr || row->slots.empty() ? slot::Kind::Rest : row->slots[0].kind;
  };
  const auto word = spot.before.back();
  const bool is_line =
      spot.before.size() == 1 || word == testing::info(testing::LineWord::Reach).word;
  return is_line ? first(row_of(testing::line_words, word))
                 : first(row_of(testing::expectations, word));
}

/// Suggests the known words of a kind; returns false if there are none.
bool suggest_values(Suggestions& out, slot::Kind kind) {
  const auto add = [&](std::string_view word, std::string_view summary) {
    out.items.push_back({std::string(word), SuggestionKind::Value, std::string(summary), ""});
  };
  if (kind == slot::Kind::Version)
    for (const auto& row : spec::basic_versions)
      add(row.text, row.summary);
  if (kind == slot::Kind::Firmware)
    for (const auto& row : spec::firmwares)
      add(row.name, row.summary);
  if (kind == slot::Kind::Colour)
    for (const auto& row : spec::led_colours)
      add(row.name, "");
  return !out.items.empty();
}

Suggestions suggest(const Source& source, std::uint32_t offset, const LanguageOptions& options) {
  const auto spot = spot_at(source, offset);
  Suggestions out;
  out.replaces = {spot.span.begin, offset};
  if (spot.before.empty()) {
    suggest_rows(out, testing::line_words, reference::test_lines_section(), test_language_id);
    suggest_rows(out, vm::stimulus_words, reference::stimulus_section(), test_language_id);
  } else if (asks_what(spot)) {
    suggest_rows(out, testing::expectations, reference::expectations_section(), test_language_id);
  } else if (is_stimulus_place(spot)) {
    suggest_rows(out, vm::stimulus_words, reference::stimulus_section(), test_language_id);
  } else if (kind_behind(spot) == slot::Kind::Zone) {
    suggest_zones(out, source, options);
  } else if (suggest_values(out, kind_behind(spot))) {
    return out;
  } else if (const auto* join = row_of(testing::join_words, spot.before.back());
             join != nullptr && join->slots[0].kind == slot::Kind::Rest) {
    suggest_rows(out, testing::expectations, reference::expectations_section(), test_language_id);
  } else if (is_expectation(spot.before[0]) || spot.before[0] == "reach") {
    suggest_rows(out, testing::when_words, reference::test_lines_section(), test_language_id);
    suggest_rows(out, testing::join_words, reference::test_lines_section(), test_language_id);
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
                       plural(static_cast<std::uint64_t>(test.points), "point"),
                       {source.line_start(test.line), std::max(end, test.name.span.end)},
                       test.name.span});
  }
  return symbols;
}

std::optional<std::string> format(const Source& source) {
  return testing::layout(source.text());
}

tl::expected<Renaming, std::string> rename(const Source&, std::uint32_t, std::string_view,
                                           const LanguageOptions&) {
  return tl::unexpected(std::string("nothing in a test file can be renamed"));
}

} // namespace

const LanguageService test_service = {
    check,  hover,  suggest,           outline,    nothing::occurrences,
    rename, format, nothing::rewrites, &test_shape};

} // namespace orb::editor
