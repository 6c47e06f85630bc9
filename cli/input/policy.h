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

/// The user's severities: `--deny`, `--warn`, `--allow`, `--max-errors`. A rule's name wins over
/// `all`, then the milder severity wins.
struct Policy {
  std::vector<std::string> deny; ///< rules to treat as errors; `all` for every finding
  std::vector<std::string> warn;
  std::vector<std::string> allow;
  std::size_t max_errors = 100; ///< how many findings to show; 0 for all
};

/// Adds the options to a command.
void add_policy_options(const Command& command, Policy& policy);

/// Returns false, and reports it, if the policy names an unknown rule.
bool check_rules(Context& context, const Policy& policy);

/// Applies the severities and removes what is allowed.
void weigh(const Policy& policy, std::vector<Diagnostic>& diagnostics);

/// Limits the findings of all files to `max_errors`, dropping infos first and errors last. Returns
/// how many were dropped.
std::size_t cut(const Policy& policy, std::vector<FileFindings>& files);

} // namespace orb::cli
