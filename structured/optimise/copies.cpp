#include "structured/optimise/copies.h"

#include "structured/analyse/interference.h"

namespace orb::structured {
namespace {

/// Puts for each variable the one that stands for its class.
void rename_all(Code& code, const Classes& classes) {
  for (std::uint32_t v = 0; v < code.variables.size(); ++v)
    if (classes.find(v) != v)
      code.variables[v].holder = classes.find(v);
  for (auto& term : code.terms)
    if (term.kind == TermKind::Variable)
      term.left = classes.find(term.left);
  for (auto& part : code.parts)
    if (part.kind == PartKind::Variable)
      part.value = classes.find(part.value);
  for (auto& line : code.lines) {
    if (line.kind == LineKind::Let || line.kind == LineKind::For || line.kind == LineKind::Next ||
        line.kind == LineKind::Switch)
      line.variable = classes.find(line.variable);
    if (line.kind == LineKind::Let && code.terms[line.term].kind == TermKind::Variable &&
        code.terms[line.term].left == line.variable)
      line.kind = LineKind::Nothing;
  }
}

} // namespace

bool join_copies(Code& code) {
  bool any = false;
  const auto may_join = [&](std::uint32_t v) {
    return v != index_variable && !code.variables[v].kept;
  };
  each_copy(code, [&](std::uint32_t a, std::uint32_t b) {
    any = any || (a != b && may_join(a) && may_join(b));
  });
  if (!any)
    return false;
  const Interference interference(code);
  Classes classes(interference.edges, code.variables.size());
  any = false;
  each_copy(code, [&](std::uint32_t a, std::uint32_t b) {
    if (may_join(a) && may_join(b))
      any = classes.join(a, b) || any;
  });
  if (any)
    rename_all(code, classes);
  return any;
}

} // namespace orb::structured
