// Results for spreadsheets.

#include "base/text/utf8.h"
#include "testing/texts.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <fmt/format.h>

namespace orb::testing {
namespace {

// Without it, spreadsheets do not read the bytes as UTF-8.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Escapes a field. Spreadsheets evaluate text that begins with one of these signs, unless an
/// apostrophe precedes it.
std::string field(std::string_view text) {
  auto out = to_valid_utf8(text);
  if (!out.empty() && std::string_view("=+-@\t\r").find(out.front()) != std::string_view::npos)
    out.insert(0, "'");
  if (out.find_first_of(",;\"\r\n") == std::string::npos)
    return out;
  for (std::size_t at = 0; (at = out.find('"', at)) != std::string::npos; at += 2)
    out.insert(at, "\"");
  return "\"" + out + "\"";
}

std::string points(const GroupResult* cell) {
  if (cell == nullptr || cell->cases.empty())
    return {};
  return std::to_string(cell->verdict() == Verdict::Passed ? cell->points : 0);
}

/// Why a program could not be run, on one line.
std::string problem(const Table::Row& row) {
  for (const auto* cell : row.cells)
    if (cell != nullptr)
      if (const auto* one = first_failure(*cell); one != nullptr && !one->problem.empty())
        return one->problem.substr(0, one->problem.find('\n'));
  return {};
}

} // namespace

std::string render_csv(const Results& results, const Speech& speech) {
  const auto table = whole_table(results);
  const std::string comma = speech.code == "en" ? "," : ";";
  const auto word = [&](const Message& message) { return field(speech.say(message)); };
  auto out = std::string(byte_order_mark) + word(texts::Program());
  for (const auto& test : table.tests)
    out += comma + word(Message::as_is(test));
  for (const auto& head : {texts::Points(), texts::Of(), texts::Problem()})
    out += comma + word(head);
  out += "\r\n";
  for (const auto& row : table.rows) {
    out += field(row.program);
    for (const auto* cell : row.cells)
      out += comma + points(cell);
    out += fmt::format("{0}{1}{0}{2}{0}{3}\r\n", comma, row.points, row.points_of,
                       field(problem(row)));
  }
  return out;
}

} // namespace orb::testing
