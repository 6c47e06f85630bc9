#include "structured/analyse/proofs.h"

#include "spec/limits.h"
#include "structured/analyse/flow.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <span>

namespace orb::structured {
namespace {

using compiler::Range;
using spec::Operator;

/// Calls `visit(variable, n)` where a term is a variable with a number added.
template <typename Visit>
void if_sum(const Code& code, std::uint32_t term, Visit visit) {
  const auto& node = code.terms[term];
  if (node.kind == TermKind::Variable)
    return visit(node.left, 0);
  const bool adds = node.what == static_cast<int>(Operator::Add);
  if (node.kind != TermKind::Binary || !code.is_number(node.right) ||
      code.terms[node.left].kind != TermKind::Variable ||
      (!adds && node.what != static_cast<int>(Operator::Subtract)))
    return;
  const auto value = code.terms[node.right].value;
  if (adds || value != std::numeric_limits<std::int32_t>::min())
    visit(code.terms[node.left].left, adds ? value : -value);
}

/// What is known after an element is used whose index line `i` sets to `variable` and a number.
void prove(const Code& code, std::uint32_t i, std::uint32_t variable, std::int32_t added,
           std::span<const std::uint32_t> named, std::vector<Proof>& proofs) {
  Range index{1, spec::value_of(spec::Limit::IndexedVariables)};
  std::vector<std::uint32_t> labels; // that the tests lead to
  for (++i; i < code.lines.size(); ++i) {
    const auto& line = code.lines[i];
    if (line.kind == LineKind::Label) {
      const auto seen = std::count(labels.begin(), labels.end(), line.label);
      if (static_cast<std::uint32_t>(seen) != named[line.label])
        return;
      continue;
    }
    if (line.kind == LineKind::Nothing || (line.kind == LineKind::Let && line.guard))
      continue;
    if (line.kind == LineKind::If && line.guard) {
      const auto& relation = code.conditions[line.condition].first;
      const bool lower = relation.comparison == Comparison::Less ||
                         relation.comparison == Comparison::GreaterEqual;
      if (!code.is_number(relation.right))
        return;
      (lower ? index.lo : index.hi) = code.terms[relation.right].value;
      labels.push_back(line.label);
      continue;
    }
    const bool uses = (effects_of(code, line) & effect::elements) != 0 || sets_element(code, line);
    bool changes = callee_of(line) != none;
    each_write(code, line,
               [&](std::uint32_t v) { changes = changes || v == variable || v == index_variable; });
    if (uses && !changes)
      proofs[i] = {variable, {index.lo - added, index.hi - added}};
    if (uses || changes || line.kind == LineKind::If || !falls_through(line))
      return;
  }
}

} // namespace

std::vector<bool> counters_of(const Code& code) {
  std::vector<bool> counts(code.variables.size(), true);
  for (const auto& line : code.lines) {
    bool steps = line.kind == LineKind::Let && code.is_number(line.term) &&
                 std::abs(std::int64_t{code.terms[line.term].value}) <= most_start;
    if (line.kind == LineKind::Let)
      if_sum(code, line.term, [&](std::uint32_t variable, std::int32_t step) {
        steps = variable == line.variable && std::abs(std::int64_t{step}) <= most_step;
      });
    if (!steps)
      each_write(code, line, [&](std::uint32_t v) { counts[v] = false; });
  }
  return counts;
}

std::vector<Proof> proofs_of(const Code& code) {
  std::vector<Proof> proofs(code.lines.size());
  const auto named = names_of_labels(code);
  for (std::uint32_t i = 0; i < code.lines.size(); ++i)
    if (const auto& line = code.lines[i];
        line.kind == LineKind::Let && line.variable == index_variable && !line.guard)
      if_sum(code, line.term, [&](std::uint32_t variable, std::int32_t added) {
        if (variable != index_variable && std::abs(std::int64_t{added}) <= most_start)
          prove(code, i, variable, added, named, proofs);
      });
  return proofs;
}

} // namespace orb::structured
