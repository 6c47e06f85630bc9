// The tables of orbBasic.

#include "base/text/text.h"
#include "reference/sections.h"
#include "spec/basic.h"
#include "spec/colours.h"
#include "spec/limits.h"
#include "structured/text/link_blocks.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::reference {
namespace {

std::string range(std::int64_t least, std::int64_t greatest, std::string_view unit) {
  return fmt::format("{} to {}{}{}", least, greatest, unit.empty() ? "" : " ", unit);
}

std::string since(spec::BasicVersion version) {
  return fmt::format("orbBasic {}", spec::info(version).text);
}

std::string_view describe_in_then(spec::InThen in_then) {
  switch (in_then) {
  case spec::InThen::Listed: return "yes";
  case spec::InThen::Unlisted: return "works, but is not documented";
  case spec::InThen::Refused: return "no, a syntax error";
  }
  return "";
}

std::string_view describe_in_then(spec::Access access) {
  switch (access) {
  case spec::Access::Read: return "read";
  case spec::Access::ReadWrite: return "read and write";
  case spec::Access::ReadClears: return "read; reading sets it to 0";
  }
  return "";
}

/// The statement that ends what this one begins, or the reverse; null if there is none.
const spec::StatementInfo* partner(const spec::StatementInfo& row) {
  if (row.form != spec::Form::Loop && row.form != spec::Form::LoopEnd)
    return nullptr;
  const auto form = row.form == spec::Form::Loop ? spec::Form::LoopEnd : spec::Form::Loop;
  return std::find_if(spec::statements.begin(), spec::statements.end(),
                      [&](const auto& other) { return other.form == form; });
}

/// A statement's example, or the examples of both partners in the order in which they run.
std::string example(const spec::StatementInfo& row) {
  const auto* other = partner(row);
  if (other == nullptr)
    return std::string(row.example);
  const auto& [first, last] =
      row.form == spec::Form::Loop ? std::pair{row, *other} : std::pair{*other, row};
  return fmt::format("{}\n{}", first.example, last.example);
}

/// True if a usage line contains `word` as a whole word.
bool names(std::string_view usage, std::string_view word) {
  for (auto at = usage.find(word); at != std::string_view::npos; at = usage.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_letter(usage[at - 1])) && (end == usage.size() || !is_letter(usage[end])))
      return true;
  }
  return false;
}

Swatch swatch(const spec::LedColour& row) {
  return {fmt::format("{} {}", row.code, row.name), row.red, row.green, row.blue};
}

} // namespace

Section statements_section() {
  Section section{"statements", "Statements", "statement", {}};
  for (const auto& row : spec::statements) {
    Entry entry;
    entry.name = row.word;
    entry.summary = row.summary;
    entry.facts.emplace_back("usage", row.usage);
    for (const auto& parameter : row.parameters())
      entry.facts.emplace_back(parameter.name,
                               range(parameter.least, parameter.greatest, parameter.unit));
    if (const auto* other = partner(row))
      entry.facts.emplace_back("goes with", fmt::format("`{}`", other->word));
    if (row.statement == spec::Statement::Ledc)
      for (const auto& colour : spec::led_colours) {
        entry.swatches.push_back(swatch(colour));
        if (colour.code == 0)
          entry.facts.emplace_back("colours", entry.swatches.back().name);
        else
          entry.facts.back().second += ", " + entry.swatches.back().name;
      }
    entry.facts.emplace_back("since", since(row.since));
    entry.facts.emplace_back("after then", describe_in_then(row.in_then));
    entry.facts.emplace_back("source", row.source);
    entry.code.emplace_back("example", example(row));
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section words_section() {
  Section section{"words", "Words inside statements", "word of a statement", {}};
  for (const auto word : spec::particles)
    for (const auto& row : spec::statements) {
      if (!names(row.usage, word))
        continue;
      Entry entry;
      entry.name = word;
      entry.summary = fmt::format("a part of `{}`, which {}", row.word, row.summary);
      entry.facts.emplace_back("usage", row.usage);
      entry.code.emplace_back("example", example(row));
      section.entries.push_back(std::move(entry));
    }
  return section;
}

Section letters_section() {
  Section section{"letters", "Variables", "variable", {}};
  const auto greatest = spec::value_of(spec::Limit::GreatestInteger);
  const auto values = range(-greatest, greatest, "");
  Entry plain;
  plain.name = "A to X";
  plain.summary = "a program variable: a number, 0 when the program starts";
  for (char letter = 'A'; letter <= 'X'; ++letter)
    plain.aliases.emplace_back(1, letter);
  plain.facts.emplace_back("range", values);
  plain.facts.emplace_back("small letters", "the same variables: `a` is `A`");
  plain.code.emplace_back("example", "10 A = A + 1");
  Entry index{.name = "Y",
              .summary = "a variable, and the index of the element that `Z` stands for"};
  index.facts.emplace_back(
      "range", fmt::format("{}; where `Z` is used, {}", values,
                           range(1, spec::value_of(spec::Limit::IndexedVariables), "")));
  Entry element{.name = "Z", .summary = "the list element that `Y` selects"};
  element.facts.emplace_back("range", values);
  element.code.emplace_back("example", "10 Y = 3\n20 Z = 100");
  section.entries = {std::move(plain), std::move(index), std::move(element)};
  return section;
}

Section colours_section() {
  Section section{"colours", "Colours of LEDC", "colour", {}};
  for (const auto& row : spec::led_colours) {
    Entry entry;
    entry.name = row.name;
    entry.summary = fmt::format("colour {} of `LEDC`", row.code);
    entry.facts.emplace_back("LEDC", fmt::format("{}", row.code));
    entry.facts.emplace_back("RGB", fmt::format("{},{},{}", row.red, row.green, row.blue));
    entry.swatches.push_back(swatch(row));
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section functions_section() {
  Section section{"functions", "Functions", "function", {}};
  for (const auto& row : spec::functions) {
    Entry entry;
    entry.name = row.word;
    entry.summary = row.summary;
    entry.facts.emplace_back("operand", range(row.least, row.greatest, ""));
    entry.facts.emplace_back("source", row.source);
    entry.code.emplace_back("example", row.example);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section variables_section() {
  Section section{"variables", "System variables", "system variable", {}};
  for (const auto& row : spec::variables) {
    Entry entry;
    entry.name = row.word;
    if (!row.old_word.empty())
      entry.aliases.emplace_back(row.old_word);
    entry.summary = row.summary;
    entry.facts.emplace_back("access", describe_in_then(row.access));
    entry.facts.emplace_back("range", range(row.least, row.greatest, row.unit));
    entry.facts.emplace_back("since", since(row.since));
    if (!row.old_word.empty())
      entry.facts.emplace_back("formerly", row.old_word);
    entry.facts.emplace_back("source", row.source);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section operators_section() {
  Section section{"operators", "Operators and relations", "operator", {}};
  for (const auto& row : spec::operators) {
    Entry entry;
    entry.name = std::string(1, row.symbol);
    entry.summary = row.summary;
    entry.facts.emplace_back("precedence", row.level == spec::Level::Medium ? "medium" : "low");
    entry.facts.emplace_back("example", row.example);
    section.entries.push_back(std::move(entry));
  }
  for (const auto& row : spec::relations) {
    Entry entry;
    entry.name = std::string(1, row.symbol);
    entry.summary = row.summary;
    entry.facts.emplace_back("where", "between two expressions after `if`");
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section basic_errors_section() {
  Section section{"errors", "Errors in a running program", "orbBasic error", {}};
  for (const auto& row : spec::basic_errors) {
    const auto code = spec::code(row.error);
    Entry entry;
    entry.name = fmt::format("{:02X}h", code);
    entry.aliases = {std::string(row.text), fmt::format("{}", code), fmt::format("0x{:02X}", code)};
    entry.summary = fmt::format("{}: {}", row.text, row.summary);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section structured_words_section() {
  Section section{
      "structured-words", "Words of structured orbBasic", "word of structured orbBasic", {}};
  const auto add = [&](const structured::WordInfo& row) {
    Entry entry;
    entry.name = row.word;
    if (structured::end_of_block(row.word))
      entry.aliases.push_back(fmt::format("end {}", row.word));
    entry.summary = row.summary;
    entry.facts.emplace_back("usage", row.usage);
    if (!row.example.empty())
      entry.code.emplace_back("example", row.example);
    section.entries.push_back(std::move(entry));
  };
  for (const auto& row : structured::keywords)
    add(row);
  for (const auto& row : structured::wider_words)
    add(row);
  return section;
}

Section basic_flags_section() {
  Section section{"basic-flags", "Flags of basflg", "orbBasic flag", {}};
  for (const auto& row : spec::basic_flags) {
    Entry entry;
    entry.name = row.symbol;
    entry.summary = row.summary;
    entry.facts.emplace_back("value", fmt::format("{}", static_cast<int>(row.flag)));
    entry.facts.emplace_back("since", std::string(spec::info(row.since).text));
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
