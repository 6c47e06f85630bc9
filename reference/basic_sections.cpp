// What the orbBasic tables know.

#include "reference/sections.h"
#include "spec/basic.h"
#include "structured/words.h"

#include <fmt/format.h>

namespace orb::reference {
namespace {

std::string range(std::int64_t least, std::int64_t greatest, std::string_view unit) {
  return fmt::format("{} to {}{}{}", least, greatest, unit.empty() ? "" : " ", unit);
}

std::string since(spec::BasicVersion version) {
  return fmt::format("orbBasic {}", spec::info(version).text);
}

std::string_view describe(spec::InThen in_then) {
  switch (in_then) {
  case spec::InThen::Listed: return "yes";
  case spec::InThen::Unlisted: return "works, but is not documented";
  case spec::InThen::Refused: return "no, a syntax error";
  }
  return "";
}

std::string_view describe(spec::Access access) {
  switch (access) {
  case spec::Access::Read: return "read";
  case spec::Access::ReadWrite: return "read and write";
  case spec::Access::ReadClears: return "read; reading sets it to 0";
  }
  return "";
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
    entry.facts.emplace_back("since", since(row.since));
    entry.facts.emplace_back("after then", describe(row.in_then));
    entry.facts.emplace_back("source", row.source);
    entry.code.emplace_back("example", row.example);
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
    entry.facts.emplace_back("access", describe(row.access));
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
  Section section{"errors", "Errors of a running program", "orbBasic error", {}};
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
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
