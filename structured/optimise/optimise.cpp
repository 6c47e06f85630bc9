#include "structured/optimise/optimise.h"

#include "structured/optimise/forward.h"
#include "structured/optimise/jumps.h"
#include "structured/optimise/long_prints.h"
#include "structured/optimise/switches.h"
#include "structured/optimise/values.h"

namespace orb::structured {
namespace {

// Beyond these no robot holds the program, and looking at it would take long.
constexpr std::size_t most_lines = 16384;
constexpr std::size_t most_bits = std::size_t{1} << 27; ///< of sets of variables

bool is_huge(const Code& code) {
  return code.lines.size() > most_lines ||
         (code.lines.size() + code.routines.size()) * code.variables.size() > most_bits;
}

/// Whether a variable is read that nothing sets: it is 0 all through, which was not seen as long as
/// something that never runs, or whose value has moved, set it.
bool reads_unset(const Code& code) {
  std::vector<bool> set(code.variables.size(), false);
  for (const auto& line : code.lines)
    each_write(code, line, [&](std::uint32_t v) { set[v] = true; });
  bool found = false;
  for (const auto& line : code.lines)
    each_line_read(code, line, [&](std::uint32_t v) { found = found || !set[v]; });
  return found;
}

} // namespace

void optimise(Code& code) {
  if (code.too_large)
    return; // it ends in the middle: labels are missing
  clean_jumps(code);
  code.too_large = is_huge(code);
  if (code.too_large)
    return;
  use_values(code);
  const auto wrong_indices = code.wrong_indices; // later not every place of a statement is left
  write_switches(code);
  clean_jumps(code);
  forward_values(code);
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds && reads_unset(code); ++round) {
    use_values(code);
    clean_jumps(code);
    forward_values(code);
  }
  code.wrong_indices = wrong_indices;
  cut_prints(code);
}

} // namespace orb::structured
