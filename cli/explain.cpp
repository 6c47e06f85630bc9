#include "base/suggest.h"
#include "cli/commands.h"
#include "reference/knowledge.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

bool answers_to(const reference::Entry& entry, std::string_view word) {
  return entry.name == word ||
         std::find(entry.aliases.begin(), entry.aliases.end(), word) != entry.aliases.end();
}

/// Every entry that `word` names, one after the other: `roll` is a variable and a macro command.
std::string explain(const std::vector<reference::Section>& sections, std::string_view word) {
  std::string out;
  for (const auto& section : sections)
    for (const auto& entry : section.entries)
      if (answers_to(entry, word))
        out += (out.empty() ? "" : "\n") + reference::print_entry(section, entry);
  return out;
}

std::vector<std::string> all_names(const std::vector<reference::Section>& sections) {
  std::vector<std::string> names;
  for (const auto& section : sections)
    for (const auto& entry : section.entries) {
      names.push_back(entry.name);
      names.insert(names.end(), entry.aliases.begin(), entry.aliases.end());
    }
  return names;
}

void run(Context& context, const std::string& word) {
  const auto sections = reference::knowledge();
  const auto text = explain(sections, word);
  if (!text.empty()) {
    print_out(text);
    return;
  }
  const auto names = all_names(sections);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const auto meant = closest(word, views);
  fail(context, {ExitCode::BadInput, fmt::format("nothing is known about `{}`{}", word,
                                                 meant ? fmt::format("; did you mean `{}`?", *meant)
                                                       : "; `orb spec` lists all there is")});
}

} // namespace

void add_explain(CLI::App& app, Context& context) {
  auto* command = add_command(app, "explain", "say all that the tables know about a word",
                              "orb explain goroll\norb explain 08h\norb explain unknown-statement");
  auto word = std::make_shared<std::string>();
  command->add_option("WORD", *word, "a rule, statement, error, variable or command")->required();
  command->callback([&context, word] { run(context, *word); });
}

} // namespace orb::cli
