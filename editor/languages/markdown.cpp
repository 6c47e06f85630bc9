#include "editor/languages/markdown.h"

#include "compiler/text/parse_basic.h"
#include "editor/languages/basic/basic_names.h"
#include "editor/languages/structured/structured_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor {
namespace {

/// Shows an example from the tables in the reader's language. For structured programs it drops line
/// numbers that nothing jumps to. (structured::lift would do more, but every visitor of the
/// playground would have to load it.)
std::string example_in(std::string_view language, const std::string& source) {
  if (language != structured_language_id)
    return source;
  const auto program = compiler::parse(source);
  const auto names = line_names(program);
  if (std::any_of(names.begin(), names.end(), [](const LineName& name) { return name.is_target; }))
    return source;
  auto text = source;
  for (auto line = program.lines.rbegin(); line != program.lines.rend(); ++line)
    if (const auto end = text.find_first_not_of(' ', line->number_span.end);
        line->number_span.size() > 0 && end != std::string::npos)
      text.erase(line->number_span.begin, end - line->number_span.begin);
  return text;
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
