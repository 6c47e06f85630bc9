#include "structured/analyse/sizes.h"

namespace orb::structured {

std::uint32_t bytes_of(const Code& code, const CodeLine& line) {
  std::uint32_t bytes = line_bytes;
  each_root(code, line,
            [&](std::uint32_t root) { bytes += 3 * std::uint32_t{code.terms[root].size} / 2; });
  switch (line.kind) {
  case LineKind::Nothing:
  case LineKind::Label: return 0;
  case LineKind::If: return bytes + 12;
  case LineKind::Print:
  case LineKind::Do:
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      bytes += code.parts[i].text.size() + 1;
    return bytes + 5;
  case LineKind::Let:
  case LineKind::SetElement:
  case LineKind::SetSystem: return bytes + 2;
  case LineKind::Goto:
  case LineKind::For:
  case LineKind::Next:
  case LineKind::Gosub:
  case LineKind::Return:
  case LineKind::Switch:
  case LineKind::On:
  case LineKind::Choice: return bytes + 7;
  }
  return bytes;
}

bool fits_arm(const CodeLine& line) {
  return line.kind == LineKind::Let || line.kind == LineKind::Print ||
         line.kind == LineKind::SetElement || line.kind == LineKind::SetSystem ||
         (line.kind == LineKind::Do && spec::info(line.robot).in_then == spec::InThen::Listed);
}

CodeLine copy_line(Code& code, CodeLine line) {
  if (line.kind == LineKind::If) {
    code.conditions.push_back(Condition{code.conditions[line.condition]});
    line.condition = static_cast<std::uint32_t>(code.conditions.size()) - 1;
  }
  if (line.parts_end > line.parts_begin && line.kind != LineKind::Switch) {
    const auto begin = static_cast<std::uint32_t>(code.parts.size());
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      code.parts.push_back(Part{code.parts[i]});
    line.parts_begin = begin;
    line.parts_end = static_cast<std::uint32_t>(code.parts.size());
  }
  each_root(code, line, [&](std::uint32_t& root) { root = code.copy(root); });
  return line;
}

} // namespace orb::structured
