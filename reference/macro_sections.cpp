// The macro tables.

#include "base/text/text.h"
#include "reference/sections.h"
#include "spec/macro.h"

#include <fmt/format.h>

namespace orb::reference {
namespace {

std::string describe_operand(const spec::MacroOperand& operand) {
  if (operand.kind == spec::MacroOperandKind::Text)
    return fmt::format("text, preceded by its length in {} bytes", operand.width);
  const auto unit = spec::to_string(operand.unit);
  auto out = fmt::format("{} to {}{}{}, {}", operand.minimum, operand.maximum,
                         unit.empty() ? "" : " ", unit, plural(operand.width, "byte"));
  for (std::size_t i = 0; i < operand.word_count; ++i)
    out +=
        fmt::format("{}{} {}", i == 0 ? "; " : ", ", operand.words[i].value, operand.words[i].word);
  return out;
}

/// The bytes of a command as a pattern: `05 speed heading:2 delay`.
std::string layout(const spec::MacroCommandInfo& row) {
  auto out = fmt::format("{:02X}", row.code);
  for (const auto& operand : row) {
    out += fmt::format(" {}", operand.name);
    if (operand.width > 1)
      out += fmt::format(":{}", operand.width);
  }
  return out;
}

} // namespace

Section macro_commands_section() {
  Section section{"macro-commands", "Macro commands", "macro command", {}};
  for (const auto& row : spec::macro_commands) {
    Entry entry;
    entry.name = row.mnemonic;
    entry.aliases.emplace_back(row.title);
    entry.summary = row.summary;
    entry.facts.emplace_back("bytes", layout(row));
    for (const auto& operand : row)
      entry.facts.emplace_back(operand.name, describe_operand(operand));
    entry.facts.emplace_back("executive", fmt::format("{} and later", row.executive));
    entry.facts.emplace_back("documents", row.title);
    entry.facts.emplace_back("source", row.source);
    entry.code.emplace_back("example", row.example);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section macro_flags_section() {
  Section section{"macro-flags", "Macro flags", "macro flag", {}};
  for (const auto& row : spec::macro_flags) {
    Entry entry;
    entry.name = row.word;
    entry.aliases.emplace_back(row.name);
    entry.summary = row.summary;
    entry.facts.emplace_back("value", fmt::format("{:02X}h", row.bit));
    entry.facts.emplace_back("documents", row.name);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
