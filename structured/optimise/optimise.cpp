#include "structured/optimise/optimise.h"

#include "structured/optimise/copies.h"
#include "structured/optimise/elements.h"
#include "structured/optimise/forward.h"
#include "structured/optimise/hoist.h"
#include "structured/optimise/inline.h"
#include "structured/optimise/jumps.h"
#include "structured/optimise/long_prints.h"
#include "structured/optimise/sink.h"
#include "structured/optimise/switches.h"
#include "structured/optimise/tails.h"
#include "structured/optimise/values.h"
#include "structured/optimise/webs.h"

namespace orb::structured {
namespace {

// Beyond these no robot holds the program, and looking at it would take long.
constexpr std::size_t most_lines = 16384;
constexpr std::size_t most_bits = std::size_t{1} << 27; ///< of sets of variables

bool is_huge(const Code& code) {
  return code.lines.size() > most_lines ||
         (code.lines.size() + code.routines.size()) * code.variables.size() > most_bits;
}

} // namespace

void optimise(Code& code, Shape shape) {
  if (code.too_large)
    return; // it ends in the middle: labels are missing
  clean_jumps(code);
  code.too_large = is_huge(code);
  if (code.too_large)
    return;
  use_values(code);
  const auto wrong_indices = code.wrong_indices; // later not every place of a statement is left
  write_switches(code);
  constexpr int most_rounds = 12;
  bool changed = shape == Shape::Shortest; // the passes below move and join lines
  bool joined = false;
  for (int round = 0; round < most_rounds && changed; ++round) {
    clean_jumps(code);
    changed = split_variables(code);
    changed = forward_values(code) || changed;
    changed = merge_tails(code, itself) || changed;
    changed = inline_calls(code) || changed;
    changed = straighten(code) || changed;
    changed = use_values(code, joined ? Ways::Split : Ways::Keep) || changed;
    if (!changed && !joined) {
      joined = true; // once nothing is left that reads the original instead
      changed = use_elements(code);
      changed = join_copies(code) || changed || use_values(code, Ways::Split);
    }
  }
  clean_jumps(code);
  if (shape == Shape::Shortest) {
    hoist_arms(code);
    sink_into_arms(code);
  }
  code.wrong_indices = wrong_indices;
  cut_prints(code);
}

} // namespace orb::structured
