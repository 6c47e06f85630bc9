// Formats for forges.

#include "base/text/text.h"
#include "base/text/utf8.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::testing {
namespace {

std::string without_last_line_end(std::string text) {
  if (text.ends_with('\n'))
    text.pop_back();
  return text;
}

/// Where text goes in a command of GitHub's runners: the message, or one of its properties.
enum class In : std::uint8_t { Message, Property };
std::string github(std::string_view text, In in) {
  std::string out;
  for (const char c : to_valid_utf8(text)) {
    if (c == '%')
      out += "%25";
    else if (c == '\r')
      out += "%0D";
    else if (c == '\n')
      out += "%0A";
    else if (c == ':' && in == In::Property)
      out += "%3A";
    else if (c == ',' && in == In::Property)
      out += "%2C";
    else
      out += c;
  }
  return out;
}

/// Escapes text for a Markdown table cell or line.
std::string markdown(std::string_view text) {
  std::string out;
  for (const char c : to_printable(text)) {
    if (std::string_view("\\`*_[]<>|").find(c) != std::string_view::npos)
      out += '\\';
    out += c;
  }
  return out;
}

std::string mark(const GroupResult* cell) {
  if (cell == nullptr || cell->cases.empty())
    return "";
  return cell->verdict() == Verdict::Passed   ? "✅"
         : cell->verdict() == Verdict::Failed ? "❌"
                                              : "⚠️";
}

std::string markdown_table(const Table& table) {
  std::string out = "| program |";
  std::string rule = "|---|";
  for (const auto& test : table.tests) {
    out += fmt::format(" {} |", markdown(test));
    rule += "---|";
  }
  out += " points |\n" + rule + "---|\n";
  for (const auto& row : table.rows) {
    out += fmt::format("| {} |", markdown(row.program));
    for (const auto* cell : row.cells)
      out += fmt::format(" {} |", mark(cell));
    out += fmt::format(" {}/{} |\n", row.points, row.points_of);
  }
  return out + "\n";
}

std::string markdown_list(const Results& results) {
  std::string out = "| | test | program | runs |\n|---|---|---|---|\n";
  for (const auto& group : results.groups)
    if (!group.cases.empty())
      out += fmt::format("| {} | {} | {} | {} |\n", mark(&group), markdown(group.test),
                         markdown(group.program), group.cases.size());
  return out + "\n";
}

} // namespace

std::string render_github(const Results& results) {
  std::string out;
  ToldOnce told;
  for (const auto& group : results.groups) {
    const auto* one = first_failure(group);
    if (one == nullptr || !told.is_new(group, *one))
      continue;
    const auto line = one->misses.empty() ? group.line : one->misses.front().line;
    const bool of_program = one->verdict == Verdict::Error;
    auto title = of_program ? group.program : fmt::format("{} ({})", group.test, group.program);
    if (group.count > 1 && !of_program)
      title += fmt::format(", seed {}", failed_seeds(group));
    out += fmt::format("::error file={},line={},title={}::{}\n", github(group.file, In::Property),
                       line, github(title, In::Property),
                       github(without_last_line_end(story(group, *one)), In::Message));
  }
  return out + render_summary(results) + "\n";
}

std::string render_markdown(const Results& results) {
  const auto table = table_of(results);
  auto out = fmt::format("### {}\n\n", render_summary(results));
  out += table.rows.empty() ? markdown_list(results) : markdown_table(table);
  ToldOnce told;
  for (const auto& group : results.groups) {
    const auto* one = first_failure(group);
    if (one == nullptr || !told.is_new(group, *one))
      continue;
    const bool of_program = one->verdict == Verdict::Error;
    out += of_program ? fmt::format("<details><summary>{}", markdown(group.program))
                      : fmt::format("<details><summary>{}, {}", markdown(group.test),
                                    markdown(group.program));
    if (group.count > 1 && !of_program)
      out += fmt::format(", seed {}", failed_seeds(group));
    out += fmt::format("</summary>\n\n```\n{}```\n\n</details>\n\n",
                       to_terminal_text(story(group, *one)));
  }
  return out;
}

} // namespace orb::testing
