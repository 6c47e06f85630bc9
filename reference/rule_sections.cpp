// What the linters look for.

#include "assembler/rules.h"
#include "compiler/rules.h"
#include "reference/sections.h"
#include "spec/basic.h"
#include "vm/stimulus.h"

#include <fmt/format.h>

namespace orb::reference {

namespace {

void add(Section& section, const Rule& rule) {
  Entry entry;
  entry.name = rule.id;
  entry.summary = rule.summary;
  entry.facts.emplace_back("severity", to_string(rule.severity));
  if (const auto error = spec::find_error(rule.robot_error))
    entry.facts.emplace_back("on the robot", fmt::format("error {:02X}h, {}", rule.robot_error,
                                                         spec::info(*error).text));
  entry.explanation = rule.explanation;
  if (!rule.bad.empty())
    entry.code.emplace_back("bad", rule.bad);
  if (!rule.good.empty())
    entry.code.emplace_back("good", rule.good);
  section.entries.push_back(std::move(entry));
}

} // namespace

Section rules_section() {
  Section section{"rules", "Rules for orbBasic", "rule", {}};
  for (const auto& rule : compiler::rules::all())
    add(section, rule);
  return section;
}

Section macro_rules_section() {
  Section section{"macro-rules", "Rules for macros", "macro rule", {}};
  for (const auto& rule : assembler::rules::all())
    add(section, rule);
  return section;
}

Section stimulus_rules_section() {
  Section section{"stimulus-rules", "Rules for stimulus scripts", "stimulus rule", {}};
  for (const auto& rule : vm::stimulus_rules())
    add(section, rule);
  return section;
}

} // namespace orb::reference
