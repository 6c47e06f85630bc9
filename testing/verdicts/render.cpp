#include "testing/verdicts/render.h"

#include <algorithm>
#include <array>

namespace orb::testing {
namespace {

// In the order of Format.
constexpr std::array<std::string_view, 6> format_words{"text",   "json",     "junit",
                                                       "github", "markdown", "csv"};

} // namespace

std::span<const std::string_view> format_names() {
  return format_words;
}

Format format_called(std::string_view name) {
  return static_cast<Format>(std::find(format_words.begin(), format_words.end(), name) -
                             format_words.begin());
}

std::string render(const Results& results, Format format, Listing listing, Style style,
                   const Speech& speech) {
  switch (format) {
  case Format::Text: return render_text(results, listing, style, speech.say);
  case Format::Json: return render_json(results);
  case Format::JUnit: return render_junit(results);
  case Format::GitHub: return render_github(results);
  case Format::Markdown: return render_markdown(results);
  case Format::Csv: return render_csv(results, speech);
  }
  return {};
}

bool is_for_people(Format format) {
  return format == Format::Text || format == Format::Csv;
}

} // namespace orb::testing
