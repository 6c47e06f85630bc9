#include "editor/languages/structured/hints.h"

#include "editor/languages/shape.h"
#include "editor/text_places.h"
#include "editor/word_at.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

using structured::Compiled;
using structured::Kind;

/// Bytes of the image for each routine, by its place.
std::map<std::uint32_t, std::uint32_t> bytes_of(const Compiled& compiled) {
  std::map<std::uint32_t, std::uint32_t> bytes;
  const auto& image = compiled.image;
  for (std::size_t i = 0; i < image.lines.size() && i < compiled.robot.lines.size(); ++i)
    bytes[compiled.robot.lines[i].routine] += image.lines[i].size;
  return bytes;
}

/// Adds hints for numbers and constants in the robot's statements; a duration needs none.
void hint_numbers(const Compiled& compiled, std::uint32_t end, std::vector<Hint>& found) {
  for (const auto& statement : compiled.program.statements) {
    if (statement.kind != Kind::Robot || statement.span.end > end)
      continue;
    const auto parameters = spec::info(statement.robot).parameters();
    auto parameter = parameters.begin();
    for (const auto& item : compiled.program.items_of(statement)) {
      if (item.kind != structured::ItemKind::Expression || parameter == parameters.end())
        continue;
      const auto& root = compiled.program.nodes[item.value];
      const auto value = structured::evaluate(compiled.program, compiled.names, item.value);
      const bool is_plain =
          root.kind == structured::NodeKind::Number || root.kind == structured::NodeKind::Name;
      if (value && is_plain)
        if (auto hint = number_hint(parameter->name, parameter->unit, value->value, item.span.end))
          found.push_back(*std::move(hint));
      ++parameter;
    }
  }
}

} // namespace

std::map<std::uint32_t, char> letters_of(const Compiled& compiled) {
  std::map<std::uint32_t, char> letters; // by place of the declaration
  for (std::size_t v = 1; v < compiled.code.variables.size() && v < compiled.letters.of.size();
       ++v) {
    const auto symbol = compiled.code.variables[v].symbol;
    if (symbol != structured::none && compiled.letters.of[v] != structured::no_letter)
      letters[compiled.names.symbols[symbol].span.begin] =
          spec::letter_name(compiled.letters.of[v]);
  }
  return letters;
}

std::vector<Hint> structured_hints(const Source& source, const LanguageOptions& options) {
  const auto compiled = compile_structured(source, options);
  std::vector<Hint> found;
  if (compiled.robot.lines.empty() || compiled.has_errors())
    return found;
  hint_numbers(compiled, compiled.program.files.front().end, found);
  const auto end = compiled.program.files.front().end;
  for (const auto& [at, letter] : letters_of(compiled))
    if (at < end) {
      const auto name =
          std::find_if(compiled.names.symbols.begin(), compiled.names.symbols.end(),
                       [start = at](const auto& symbol) { return symbol.span.begin == start; });
      found.push_back({name->span.end, fmt::format(": {}", letter),
                       fmt::format("the robot's `{}` holds it", letter)});
    }
  const auto bytes = bytes_of(compiled);
  for (std::uint32_t r = 1; r < compiled.names.routines.size(); ++r) {
    const auto& header = compiled.program.statements[compiled.names.routines[r].statement];
    if (header.span.begin >= end)
      continue;
    const auto own = bytes.find(r);
    found.push_back(
        {end_of_line(source, header.span.begin),
         own == bytes.end() ? "no bytes of its own" : fmt::format("{} bytes", own->second),
         own == bytes.end() ? "it is inlined into its callers, or never called"
                            : "in the packed image"});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Hint& a, const Hint& b) { return a.at < b.at; });
  return found;
}

} // namespace orb::editor
