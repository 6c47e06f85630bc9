#include "editor/markdown.h"

#include "compiler/check.h"
#include "editor/structured_names.h"
#include "structured/lift.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor {
namespace {

/// An example of the tables in the language of whoever reads it: the robot's words are shown there in
/// numbered lines.
std::string example_in(std::string_view language, const std::string& source) {
  if (language != structured_language_id)
    return source;
  auto lifted = structured::lift(compiler::check(source, {}));
  return lifted.text.empty() ? source : std::move(lifted.text);
}

} // namespace

std::string entry_markdown(const reference::Section& section, const reference::Entry& entry,
                           std::string_view language) {
  auto out = fmt::format("**`{}`** ({}): {}\n", entry.name, section.kind, entry.summary);
  if (!entry.facts.empty())
    out += "\n";
  for (const auto& [caption, value] : entry.facts)
    out += caption == "usage" ? fmt::format("- {}: `{}`\n", caption, value)
                              : fmt::format("- {}: {}\n", caption, value);
  if (!entry.explanation.empty())
    out += fmt::format("\n{}\n", entry.explanation);
  for (const auto& [caption, code] : entry.code) {
    const auto source = example_in(language, code);
    out += fmt::format("\n{}:\n```{}\n{}{}```\n", caption, language, source,
                       source.ends_with("\n") ? "" : "\n");
  }
  return out;
}

std::optional<std::string> find_markdown(const reference::Section& section, std::string_view word,
                                         std::string_view language) {
  for (const auto& entry : section.entries)
    if (entry.name == word ||
        std::find(entry.aliases.begin(), entry.aliases.end(), word) != entry.aliases.end())
      return entry_markdown(section, entry, language);
  return std::nullopt;
}

} // namespace orb::editor
