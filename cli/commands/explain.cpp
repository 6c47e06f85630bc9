#include "base/rules.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "cli/commands/commands.h"
#include "cli/model/checks.h"
#include "cli/model/command_line.h"
#include "reference/foreign_sections.h"
#include "reference/knowledge.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

/// Finds the word as written, then ignoring case, then as an option without dashes.
std::string explain(const std::vector<reference::Section>& sections, Style style,
                    const std::string& word) {
  using reference::print_entries;
  auto found = print_entries(sections, style, [&](const auto& name) { return name == word; });
  if (found.empty())
    found =
        print_entries(sections, style, [&](const auto& name) { return equal_words(name, word); });
  if (found.empty())
    found = print_entries(sections, style,
                          [&](const auto& name) { return equal_words(name, "--" + word); });
  return found;
}

/// True if a statement can begin with the word. Some sensors and stimuli share the names of other
/// languages' statements (`roll`, `spin`).
bool begins_statements(const std::vector<reference::Section>& sections, const std::string& word) {
  const auto is_it = [&](const std::string& name) { return equal_words(name, word); };
  for (const auto& section : sections)
    for (const auto& entry : section.entries)
      if ((is_it(entry.name) || std::any_of(entry.aliases.begin(), entry.aliases.end(), is_it)) &&
          section.id != "variables" && section.id != "stimuli" && section.id != "macro-commands" &&
          section.id != "edu-calls")
        return true;
  return false;
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

void print_explanation(Context& context, const reference::CommandLine& line,
                       const std::string& word) {
  auto sections = reference::knowledge();
  for (auto& section : reference::commands_knowledge(line))
    sections.push_back(std::move(section));
  auto text = explain(sections, context.out_style(), word);
  if (const auto foreign = reference::foreign_knowledge(word);
      foreign && !begins_statements(sections, word)) {
    if (!text.empty())
      text += '\n';
    text += reference::print_entry(*foreign, foreign->entries.front(), context.out_style());
  }
  if (!text.empty()) {
    print_out(text);
    return;
  }
  constexpr std::size_t most = 3;
  const auto names = all_names(sections);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const auto near = nearest(word, views, most);
  fail(context,
       {ExitCode::BadInput,
        fmt::format("unknown word `{}`; {}", word,
                    near.empty() ? "`orb spec` lists everything"
                                 : fmt::format("did you mean `{}`?", fmt::join(near, "`, `")))});
}

} // namespace

void add_explain(const Command& orb, Context& context) {
  const auto command = orb.add_command(
      "explain", "explain a word: everything the tables say about it",
      "orb explain goroll\norb explain 08h\norb explain unknown-statement\norb explain -- --open");
  auto word = std::make_shared<std::string>();
  command
      .add_option(
          "WORD", *word,
          "a statement, variable, colour, error, limit, rule, command or option; or a line from "
          "another language")
      .required();
  command.callback([orb, &context, word] {
    print_explanation(context, as_data(orb), std::string(current_id(*word)));
  });
}

} // namespace orb::cli
