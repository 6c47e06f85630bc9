#include "editor/languages/basic/basic_names.h"

#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace orb::editor {
namespace {

using compiler::ItemKind;
using compiler::NodeKind;
using compiler::Program;

/// The line number in the last argument of `sleep`, if it is a literal; 0 means none.
std::optional<LineName> sleep_target(const Program& program, const compiler::StatementNode& node) {
  if (node.kind != spec::Statement::Sleep || node.error)
    return std::nullopt;
  const auto& root = program.nodes[program.as<compiler::SleepView>(node).line.value];
  if (root.kind != NodeKind::Number || root.value <= 0)
    return std::nullopt;
  return LineName{static_cast<std::uint32_t>(root.value), root.span, true, false};
}

/// The text of a comment on the line above: the title of a part of a program.
std::string_view title_above(const Program& program, std::size_t index) {
  if (index == 0)
    return {};
  const auto& above = program.lines[index - 1];
  if (above.has_number() || above.has_statement() || above.comment.size() == 0)
    return {};
  auto text = program.text_of(above.comment);
  while (!text.empty() && (text.front() == '\'' || is_blank(text.front())))
    text.remove_prefix(1);
  return text.starts_with("orb:") ? std::string_view() : text;
}

bool ends_part(const Program& program, const compiler::Line& line) {
  if (!line.has_statement())
    return false;
  const auto& node = program.statements[line.statement];
  return !node.error && (node.kind == spec::Statement::Return || node.kind == spec::Statement::End);
}

} // namespace

std::vector<LineName> line_names(const Program& program) {
  std::vector<LineName> names;
  for (const auto& line : program.lines)
    if (line.has_number())
      names.push_back({line.number, line.number_span, false, false});
  for (const auto& node : program.statements) {
    if (node.error)
      continue;
    const bool calls =
        node.kind == spec::Statement::Gosub || node.spelling == compiler::Spelling::OnGosub;
    for (const auto& item : program.items_of(node))
      if (item.kind == ItemKind::Target)
        names.push_back({item.value, item.span, true, calls});
    if (const auto target = sleep_target(program, node))
      names.push_back(*target);
  }
  return names;
}

std::vector<LetterName> letter_names(const Program& program) {
  std::vector<LetterName> names;
  for (const auto& node : program.nodes)
    if (node.kind == NodeKind::Letter || node.kind == NodeKind::Indexed)
      names.push_back(
          {node.kind == NodeKind::Letter ? node.what : indexed_letter, node.span, false});
  for (const auto& item : program.items)
    if (item.kind == ItemKind::Letter || item.kind == ItemKind::Indexed)
      names.push_back(
          {item.kind == ItemKind::Letter ? static_cast<std::uint8_t>(item.value) : indexed_letter,
           item.span, true});
  std::sort(names.begin(), names.end(),
            [](const LetterName& a, const LetterName& b) { return a.span.begin < b.span.begin; });
  return names;
}

std::vector<BasicPart> parts_of(const Program& program) {
  struct Target {
    bool is_called = false;
    bool is_listed = false;
  };
  std::map<std::uint32_t, Target> targets;
  for (const auto& name : line_names(program))
    if (name.is_target)
      targets[name.number].is_called |= name.calls;
  std::vector<BasicPart> parts;
  std::size_t part_end = 0; // last line of the current subroutine
  for (std::size_t i = 0; i < program.lines.size(); ++i) {
    const auto& line = program.lines[i];
    const auto found = line.has_number() ? targets.find(line.number) : targets.end();
    if (found == targets.end() || std::exchange(found->second.is_listed, true))
      continue;
    const bool is_called = found->second.is_called;
    if (is_called) { // one that begins inside another ends with it
      part_end = std::max(part_end, i);
      while (part_end + 1 < program.lines.size() && !ends_part(program, program.lines[part_end]))
        ++part_end;
    }
    const auto title = title_above(program, i);
    parts.push_back({i, is_called ? part_end : i, is_called,
                     title.empty() ? fmt::format("{}", line.number)
                                   : fmt::format("{} {}", line.number, title)});
  }
  return parts;
}

} // namespace orb::editor
