#pragma once

#include "base/render.h"
#include "base/style.h"
#include "testing/results.h"

#include <span>
#include <string>
#include <string_view>

// Results as text. Equal results give equal bytes.

namespace orb::testing {

enum class Format : std::uint8_t { Text, Json, JUnit, GitHub, Markdown, Csv };

/// The formats by name, in the order of the help.
std::span<const std::string_view> format_names();
/// Returns the format for a name from format_names().
Format format_called(std::string_view name);

/// Which tests a text lists.
enum class Listing : std::uint8_t { Failures, All };

/// The language of results. Formats for machines, such as JSON, are in English.
struct Speech {
  Say say = &in_english;
  std::string code = "en"; ///< ISO 639-1
};

/// For people: failures, a table if several programs were tested, and a summary sentence.
std::string render_text(const Results& results, Listing listing, Style style,
                        const Say& say = &in_english);
/// The summary: `3 of 4 tests passed, 5 of 7 points, 604 runs`.
std::string render_summary(const Results& results, const Say& say = &in_english);
/// Schema orb.test/1 (docs/using/testing.md).
std::string render_json(const Results& results, const Say& say = &in_english);
/// For CI servers: JUnit XML, valid for the published schemas.
std::string render_junit(const Results& results);
/// Annotations for GitHub Actions: one line for each failure.
std::string render_github(const Results& results);
/// For the summary page of a forge.
std::string render_markdown(const Results& results);

/// For spreadsheets (RFC 4180 with a byte order mark). Each line has a program, its points for each
/// test, their sum, and why it could not be run. The separator is what spreadsheets in that
/// language expect: a comma, or a semicolon where the comma is the decimal sign.
std::string render_csv(const Results& results, const Speech& speech);

std::string render(const Results& results, Format format, Listing listing, Style style,
                   const Speech& speech = {});
/// True if people read the format, which makes it translatable.
bool is_for_people(Format format);

} // namespace orb::testing
