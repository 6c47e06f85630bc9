#pragma once

#include "base/source.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Checks statements whose names are resolved: their place, the number of their values, and
/// required constants.
void check(Program& program, const Names& names);

/// Calls `visit(routine, span)` with each call of a statement, in text order.
template <typename Visit>
void each_call(const Program& program, const Names& names, std::uint32_t statement, Visit visit) {
  const auto say = [&](std::uint32_t symbol, Span span) {
    if (symbol != none && names.symbols[symbol].routine != 0)
      visit(names.symbols[symbol].routine, span);
  };
  const auto& here = program.statements[statement];
  if (here.kind == Kind::Call)
    say(names.of_statement[statement], here.name_span);
  for (const auto& item : program.items_of(here))
    if (item.has_nodes())
      for (auto n = program.nodes[item.value].first; n <= item.value; ++n)
        if (program.nodes[n].kind == NodeKind::Call)
          say(names.of_node[n], program.nodes[n].span);
}

/// The routines that each routine calls, as indices, each once.
std::vector<std::vector<std::uint32_t>> calls_of(const Program& program, const Names& names);

} // namespace orb::structured
