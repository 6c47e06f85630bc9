#pragma once

#include "base/diagnostic.h"
#include "cli/context/context.h"

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

/// How the user weighs findings: `--deny`, `--warn`, `--allow`, `--max-errors`. Of two that name
/// the same rule the more particular wins (a rule over `all`), then the milder one.
struct Policy {
  std::vector<std::string> deny; ///< rules that become errors; `all` for every finding
  std::vector<std::string> warn;
  std::vector<std::string> allow;
  std::size_t max_errors = 100; ///< findings that are shown; 0 for all
};

/// Adds the options to a command.
void add_policy_options(const Command& command, Policy& policy);

/// False, and reported, where the policy names a rule that no linter has.
bool check_rules(Context& context, const Policy& policy);

/// Changes severities and leaves out what is allowed.
void weigh(const Policy& policy, std::vector<Diagnostic>& diagnostics);

/// Cuts the findings of all files to `max_errors`, keeping errors before warnings before infos.
/// Returns how many were cut.
std::size_t cut(const Policy& policy, std::vector<FileFindings>& files);

} // namespace orb::cli
