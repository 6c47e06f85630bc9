#include "structured/meaning/check.h"

#include "structured/meaning/check_pass.h"

#include <algorithm>

namespace orb::structured {

void check(Program& program, const Names& names) {
  check_expressions(program, names);
  check_statements(program, names);
  check_jumps(program, names);
  if (any_error(program.diagnostics))
    return; // what uses a name, or leaves a loop, may be the mistake
  check_names(program, names);
  check_meant(program, names);
  check_loops(program, names);
}

std::vector<std::vector<std::uint32_t>> calls_of(const Program& program, const Names& names) {
  std::vector<std::vector<std::uint32_t>> calls(names.routines.size());
  for (const auto i : program.order)
    each_call(program, names, i,
              [&](std::uint32_t routine, Span) { calls[names.routine_of[i]].push_back(routine); });
  for (auto& list : calls) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return calls;
}

} // namespace orb::structured
