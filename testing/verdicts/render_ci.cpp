// The formats that CI servers and forges read.

#include "base/text/text.h"
#include "base/text/utf8.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace orb::testing {
namespace {

std::string seconds(Duration t) {
  return fmt::format("{:.3f}", std::chrono::duration<double>(t).count());
}

/// What a case failed at, a line for each expectation.
std::string story(const GroupResult& group, const CaseResult& one) {
  if (one.omitted)
    return fmt::format("details omitted: only the first {} failures of a test are kept\n",
                       most_told);
  if (one.verdict == Verdict::Error)
    return one.problem;
  std::string out;
  for (const auto& miss : one.misses) {
    out +=
        fmt::format("{}:{}: {}: {}", group.file, miss.line, miss.expected, in_english(miss.seen));
    out += miss.where.empty() ? "\n" : fmt::format(" ({})\n", miss.where);
  }
  return one.again.empty() ? out : out + fmt::format("rerun: {}\n", one.again);
}

std::string without_last_line_end(std::string text) {
  if (text.ends_with('\n'))
    text.pop_back();
  return text;
}

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

/// What a case failed at, in a few words.
std::string short_story(const CaseResult& one) {
  if (one.omitted)
    return std::string(to_string(one.verdict));
  if (one.verdict == Verdict::Error)
    return first_line(one.problem);
  return fmt::format("{}: {}", one.misses.front().expected, in_english(one.misses.front().seen));
}

std::string test_case(const GroupResult& group, const CaseResult& one) {
  const auto name =
      group.count == 1 ? group.test : fmt::format("{}, seed {}", group.test, one.seed);
  auto out = fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{}\"",
                         escape_markup(group.program), escape_markup(name), seconds(one.lasted));
  if (one.verdict == Verdict::Passed)
    return out + "/>\n";
  const bool failed = one.verdict == Verdict::Failed;
  return out + fmt::format("><{0} message=\"{1}\" type=\"{2}\">{3}</{0}></testcase>\n",
                           failed ? "failure" : "error", escape_markup(short_story(one)),
                           failed ? "expectation" : "program", escape_markup(story(group, one)));
}

/// All that ran of one test file.
struct TestSuite {
  std::string cases;
  std::uint64_t count = 0;
  std::uint64_t failures = 0;
  std::uint64_t errors = 0;
  Duration lasted{};
};

/// One schema wants the element, the other one at least one property in it.
constexpr std::string_view properties =
    "<properties><property name=\"clock\" value=\"robot time\"/></properties>\n";

/// Text in a command of GitHub's runners; `property` in one of its properties.
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

/// Text in a cell of a Markdown table, or in a line.
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

std::string render_junit(const Results& results) {
  std::map<std::string, TestSuite> suites;
  std::vector<std::string> order;
  for (const auto& group : results.groups) {
    if (group.cases.empty())
      continue;
    if (!suites.contains(group.file))
      order.push_back(group.file);
    auto& suite = suites[group.file];
    for (const auto& one : group.cases) {
      suite.cases += test_case(group, one);
      ++suite.count;
      suite.failures += one.verdict == Verdict::Failed ? 1 : 0;
      suite.errors += one.verdict == Verdict::Error ? 1 : 0;
      suite.lasted += one.lasted;
    }
  }
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& suite = suites[order[i]];
    // No clock is read: a time would make the same results other bytes.
    out += fmt::format(
        "<testsuite name=\"{}\" package=\"orb\" id=\"{}\" timestamp=\"1970-01-01T00:00:00\" "
        "hostname=\"localhost\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
        "time=\"{}\">\n{}{}<system-out/>\n<system-err/>\n</testsuite>\n",
        escape_markup(order[i]), i, suite.count, suite.failures, suite.errors,
        seconds(suite.lasted), properties, suite.cases);
  }
  return out + "</testsuites>\n";
}

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
