#include "cli/input/policy.h"

#include "base/rules.h"
#include "base/text/suggest.h"
#include "cli/model/command.h"
#include "reference/knowledge.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::cli {
namespace {

bool names(const std::vector<std::string>& rules, std::string_view id) {
  return std::any_of(rules.begin(), rules.end(),
                     [&](const std::string& one) { return current_id(one) == id; });
}

/// The rules of both linters.
std::vector<std::string> rule_ids() {
  std::vector<std::string> ids;
  for (const auto& section : reference::knowledge())
    if (section.id.find("rules") != std::string_view::npos)
      for (const auto& entry : section.entries)
        ids.push_back(entry.name);
  return ids;
}

} // namespace

void add_policy_options(const Command& command, Policy& policy) {
  command.add_option("--deny", policy.deny, "make a rule an error; `all` for every rule")
      .type_name("RULE")
      .one_value_each();
  command.add_option("--warn", policy.warn, "make a rule a warning")
      .type_name("RULE")
      .one_value_each();
  command.add_option("--allow", policy.allow, "silence a rule").type_name("RULE").one_value_each();
  command.add_option("--max-errors", policy.max_errors, "show this many findings, 0 for all")
      .show_default();
}

bool check_rules(Context& context, const Policy& policy) {
  if (policy.deny.empty() && policy.warn.empty() && policy.allow.empty())
    return true;
  const auto ids = rule_ids();
  for (const auto* list : {&policy.deny, &policy.warn, &policy.allow})
    for (const auto& id : *list) {
      if (names(ids, current_id(id)) || (list == &policy.deny && id == "all"))
        continue;
      fail(context,
           {ExitCode::Usage, fmt::format("unknown rule `{}`; {}", id,
                                         did_you_mean(id, ids, "`orb spec rules` lists them"))});
      return false;
    }
  return true;
}

void weigh(const Policy& policy, std::vector<Diagnostic>& diagnostics) {
  std::erase_if(diagnostics, [&](const Diagnostic& d) { return names(policy.allow, d.rule->id); });
  const bool deny_all = names(policy.deny, "all");
  for (auto& diagnostic : diagnostics) {
    if (names(policy.warn, diagnostic.rule->id))
      diagnostic.severity = Severity::Warning;
    else if (deny_all || names(policy.deny, diagnostic.rule->id))
      diagnostic.severity = Severity::Error;
  }
}

std::size_t cut(const Policy& policy, std::vector<FileFindings>& files) {
  const auto counts = count(files);
  const auto total = counts.errors + counts.warnings + counts.infos;
  if (policy.max_errors == 0 || total <= policy.max_errors)
    return 0;
  // how many of each severity to keep, the worst first
  std::array<std::size_t, 3> keep{};
  auto left = policy.max_errors;
  const auto take = [&](Severity severity, std::size_t there) {
    keep[static_cast<std::size_t>(severity)] = std::min(left, there);
    left -= keep[static_cast<std::size_t>(severity)];
  };
  take(Severity::Error, counts.errors);
  take(Severity::Warning, counts.warnings);
  take(Severity::Info, counts.infos);
  for (auto& file : files)
    std::erase_if(file.diagnostics, [&](const Diagnostic& d) {
      auto& quota = keep[static_cast<std::size_t>(d.severity)];
      if (quota == 0)
        return true;
      --quota;
      return false;
    });
  return total - policy.max_errors;
}

} // namespace orb::cli
