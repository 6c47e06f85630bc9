#pragma once

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

/// For people: failures, a table where several programs were tested, a sentence.
std::string render_text(const Results& results, Listing listing, Style style);
/// The sentence: `3 of 4 tests passed, 5 of 7 points, 604 runs`.
std::string render_summary(const Results& results);
/// Schema orb.test/1 (docs/testing.md).
std::string render_json(const Results& results);
/// For CI servers: JUnit XML, as the published schemas want it.
std::string render_junit(const Results& results);
/// Annotations of GitHub Actions: a line for each failure.
std::string render_github(const Results& results);
/// For a summary page of a forge.
std::string render_markdown(const Results& results);

/// For spreadsheets (RFC 4180): a program in each line, the points of each test, their sum, and why
/// a program could not be run.
std::string render_csv(const Results& results);

std::string render(const Results& results, Format format, Listing listing, Style style);

} // namespace orb::testing
