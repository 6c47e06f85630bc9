// What the linter of orbBasic looks for.

#include "cli/knowledge_sections.h"
#include "compiler/rules.h"
#include "spec/basic.h"

#include <fmt/format.h>

namespace orb::cli {

Section rules_section() {
  Section section{"rules", "Rules for orbBasic", "rule", {}};
  for (const auto& rule : compiler::rules::all()) {
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
  return section;
}

} // namespace orb::cli
