#include "reference/sections.h"
#include "spec/basic.h"
#include "spec/colours.h"
#include "spec/limits.h"
#include "structured/text/structured_words.h"

#include <fmt/format.h>

// docs/reference/cheatsheet.md: a printable page to keep next to the keyboard.

namespace orb::reference {
namespace {

/// The words of structured programs beyond the robot's own statements.
std::string structured_words() {
  std::string out = "| write | it |\n|---|---|\n";
  for (const auto& row : structured::keywords)
    out += fmt::format("| `{}` | {} |\n", table_cell(row.usage), row.summary);
  return out;
}

std::string statements() {
  std::string out = "| write | it |\n|---|---|\n";
  for (const auto& row : spec::statements) {
    std::string values;
    for (const auto& one : row.parameters())
      values +=
          fmt::format("{}{} {}…{}", values.empty() ? "" : ", ", one.name, one.least, one.greatest);
    if (!values.empty())
      values = fmt::format(" ({})", values);
    out += fmt::format("| `{}` | {}{} |\n", table_cell(row.usage), row.summary, values);
  }
  return out;
}

/// A list of names and meanings as running text: `**word** meaning · …`.
class List {
public:
  void add(std::string_view name, std::string_view meaning) {
    text_ += fmt::format("{}`{}` {}", text_.empty() ? "" : " · ", name, meaning);
  }
  std::string text() const { return text_ + "\n"; }

private:
  std::string text_;
};

std::string values() {
  List list;
  for (const auto& row : spec::functions)
    list.add(row.word, row.summary);
  for (const auto& row : spec::operators)
    list.add(std::string_view(&row.symbol, 1), row.summary);
  return list.text();
}

std::string relations() {
  List list;
  for (const auto& row : spec::relations)
    list.add(std::string_view(&row.symbol, 1), row.summary);
  return list.text();
}

std::string variables() {
  List list;
  for (const auto& row : spec::variables)
    list.add(row.word, fmt::format("{}…{}{}{}", row.least, row.greatest,
                                   row.unit.empty() ? "" : " ", row.unit));
  return list.text();
}

std::string colours() {
  List list;
  for (const auto& row : spec::led_colours)
    list.add(std::to_string(row.code), row.name);
  return list.text();
}

std::string flags() {
  List list;
  for (const auto& row : spec::basic_flags)
    list.add(std::to_string(static_cast<int>(row.flag)), row.summary);
  return list.text();
}

std::string errors() {
  List list;
  for (const auto& row : spec::basic_errors)
    list.add(row.text, row.summary);
  return list.text();
}

std::string limits() {
  const auto of = [](spec::Limit limit) { return spec::value_of(limit); };
  return fmt::format(
      "Lines are numbered {} to {}. {} loops and {} subroutines can be open, and {} parentheses in "
      "an "
      "expression. A `print` has at most {} characters, `data` {} values, the list `Z` {} "
      "elements, "
      "and a number is at most {}. A program can have {} bytes on every robot, {} on newer ones.\n",
      of(spec::Limit::LeastLineNumber), of(spec::Limit::GreatestLineNumber),
      of(spec::Limit::ForDepth), of(spec::Limit::GosubDepth), of(spec::Limit::ExpressionLevels),
      of(spec::Limit::PrintBytes), of(spec::Limit::DataValues), of(spec::Limit::IndexedVariables),
      of(spec::Limit::GreatestInteger), of(spec::Limit::RamBytesUntil146),
      of(spec::Limit::RamBytes));
}

} // namespace

std::string print_cheatsheet() {
  std::string out = "<!-- Printed by `orb spec --cheatsheet`; a test compares them. -->\n"
                    "# orbBasic on one page\n\n"
                    "## Structured programs (`.orb`)\n\n"
                    "One statement per line, names of your own, blocks; `'` begins a comment, "
                    "`1.5s` and `200ms` are times. `goto`, `gosub`, `on` and line numbers are not "
                    "needed; all other statements in the second table are the same.\n\n";
  out += structured_words();
  out += "\n## Numbered programs (`.bas`), and what both share\n\n"
         "A line is a number, a space and a statement; lines run in the order of the "
         "text. `'` begins a comment. Variables are `A` to `Y`, all 0 at the start, and "
         "`Z`, the element of the list that `Y` selects. Case matters: `RGB`, `goto`.\n\n";
  out += statements();
  out += fmt::format("\n**In expressions:** {}\n**Between expressions after `if`:** {}\n"
                     "**To read:** {}\n**`LEDC`:** {}\n**`basflg`:** {}\n"
                     "**What stops a program:** {}\n**Limits:** {}",
                     values(), relations(), variables(), colours(), flags(), errors(), limits());
  return out;
}

} // namespace orb::reference
