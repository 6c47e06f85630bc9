#include "structured/analyse/proofs.h"

#include "spec/limits.h"
#include "structured/analyse/flow.h"

#include <algorithm>
#include <cstdlib>
#include <span>

namespace orb::structured {
namespace {

using compiler::Range;

/// The variable that a term is, or none.
std::uint32_t variable_of(const Code& code, std::uint32_t term) {
  return code.terms[term].kind == TermKind::Variable ? code.terms[term].left : none;
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
    const auto sum = line.kind == LineKind::Let ? sum_of(code, line.term) : Sum{};
    const bool starts = sum.base == none && std::abs(sum.number) <= most_start;
    const bool steps = sum.base != none && variable_of(code, sum.base) == line.variable &&
                       std::abs(sum.number) <= most_step;
    if (line.kind != LineKind::Let || (!starts && !steps))
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
      if (const auto sum = sum_of(code, line.term); sum.base != none)
        if (const auto variable = variable_of(code, sum.base);
            variable != none && variable != index_variable && std::abs(sum.number) <= most_start)
          prove(code, i, variable, static_cast<std::int32_t>(sum.number), named, proofs);
  return proofs;
}

} // namespace orb::structured
