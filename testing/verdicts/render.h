#pragma once

#include "base/render.h"
#include "base/style.h"
#include "testing/results.h"

#include <span>
#include <string>
#include <string_view>

// Results as text. The same results give the same bytes.

namespace orb::testing {

enum class Format : std::uint8_t { Text, Json, JUnit, GitHub, Markdown, Csv };

/// The formats by name, in the order in which help lists them.
std::span<const std::string_view> format_names();
/// The format of a name that format_names() lists.
Format format_called(std::string_view name);

/// How text treats tests that passed.
enum class Listing : std::uint8_t { Failures, All };

/// In which language results are told. What programs read, such as JSON, is in English.
struct Speech {
  Say say = &in_english;
  std::string code = "en"; ///< ISO 639-1
};

/// For people: failures, a table where several programs were tested, a sentence.
std::string render_text(const Results& results, Listing listing, Style style,
                        const Say& say = &in_english);
/// The sentence: `3 of 4 tests passed, 5 of 7 points, 604 runs`.
std::string render_summary(const Results& results, const Say& say = &in_english);
/// Schema orb.test/1 (docs/testing.md).
std::string render_json(const Results& results, const Say& say = &in_english);
/// For CI servers: JUnit XML, as the published schemas want it.
std::string render_junit(const Results& results);
/// Annotations of GitHub Actions: a line for each failure.
std::string render_github(const Results& results);
/// For a summary page of a forge.
std::string render_markdown(const Results& results);

/// For spreadsheets (RFC 4180, after a byte order mark): a program in each line, the points of each
/// test, their sum, and why a program could not be run. Columns are parted as spreadsheets of that
/// language expect it: by commas, or where these part decimals by semicolons.
std::string render_csv(const Results& results, const Speech& speech);

std::string render(const Results& results, Format format, Listing listing, Style style,
                   const Speech& speech = {});
/// Whether people read that format, and so in their language.
bool is_for_people(Format format);

} // namespace orb::testing
