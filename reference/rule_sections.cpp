// The rules of the linters.

#include "assembler/text/rules.h"
#include "compiler/text/rules.h"
#include "protocol/judge/rules.h"
#include "reference/sections.h"
#include "report/rules.h"
#include "spec/basic.h"
#include "structured/text/rules.h"
#include "testing/text/rules.h"
#include "vm/rules.h"

#include <fmt/format.h>
#include <span>

namespace orb::reference {

namespace {

Entry rule_entry(const Rule& rule) {
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
  return entry;
}

Section with_rules(Section section, std::span<const Rule> rules) {
  for (const auto& rule : rules)
    section.entries.push_back(rule_entry(rule));
  return section;
}

} // namespace

Section rules_section() {
  return with_rules({"rules", "Rules for orbBasic", "rule", {}}, compiler::rules::all());
}

Section structured_rules_section() {
  return with_rules({"structured-rules", "Rules for structured orbBasic", "structured rule", {}},
                    structured::rules::all());
}

Section macro_rules_section() {
  return with_rules({"macro-rules", "Rules for macros", "macro rule", {}}, assembler::rules::all());
}

Section stimulus_rules_section() {
  return with_rules({"stimulus-rules", "Rules for stimulus scripts", "stimulus rule", {}},
                    vm::rules::all());
}

Section course_rules_section() {
  return with_rules({"course-rules", "Rules for courses", "course rule", {}}, report::rules::all());
}

Section client_rules_section() {
  return with_rules({"client-rules", "Rules for clients of robots", "client rule", {}},
                    protocol::rules::all());
}

Section test_rules_section() {
  return with_rules({"test-rules", "Rules for tests", "test rule", {}}, testing::rules::all());
}

} // namespace orb::reference
