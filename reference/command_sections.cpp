// What `orb explain` knows about the command line.

#include "reference/knowledge.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::reference {
namespace {

/// The names of an option with dashes, long ones first.
std::vector<std::string> names_of(const Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.long_names)
    names.push_back("--" + name);
  for (const auto& name : option.short_names)
    names.push_back("-" + name);
  return names;
}

std::string values_of(const Option& option) {
  if (!option.words.empty())
    return fmt::format("{}", fmt::join(option.words, ", "));
  return option.placeholder.empty() ? "nothing" : option.placeholder;
}

void add(Section& section, const Option& option, const std::string& command) {
  const auto names = names_of(option);
  if (names.empty() || option.asks_for_help)
    return;
  const auto known = std::find_if(section.entries.begin(), section.entries.end(), [&](Entry& one) {
    return one.name == names.front() && one.summary == option.summary;
  });
  if (known != section.entries.end()) {
    known->facts.front().second += ", " + command;
    return;
  }
  Entry entry{.name = names.front(),
              .aliases = {names.begin() + 1, names.end()},
              .summary = option.summary};
  entry.facts.emplace_back("of", command);
  entry.facts.emplace_back("takes", values_of(option));
  if (!option.default_value.empty())
    entry.facts.emplace_back("otherwise", option.default_value);
  if (!option.environment.empty())
    entry.facts.emplace_back("environment", option.environment);
  section.entries.push_back(std::move(entry));
}

} // namespace

std::vector<Section> commands_knowledge(const CommandLine& line) {
  Section commands{"commands", "Commands", "orb command", {}};
  Section options{"options", "Options", "option", {}};
  for (const auto& option : line.orb.options)
    add(options, option, "every command");
  for (const auto& command : line.commands) {
    Entry entry{.name = command.name, .summary = command.summary};
    if (!command.examples.empty())
      entry.code.emplace_back("examples", command.examples);
    commands.entries.push_back(std::move(entry));
    for (const auto& option : command.options)
      add(options, option, fmt::format("orb {}", command.name));
  }
  return {std::move(commands), std::move(options)};
}

} // namespace orb::reference
