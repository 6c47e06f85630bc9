#include "structured/optimise/optimise.h"

#include "structured/optimise/arms.h"
#include "structured/optimise/elements.h"
#include "structured/optimise/forward.h"
#include "structured/optimise/inline.h"
#include "structured/optimise/jumps.h"
#include "structured/optimise/known_values.h"
#include "structured/optimise/long_prints.h"
#include "structured/optimise/repeated.h"
#include "structured/optimise/switches.h"
#include "structured/optimise/tails.h"
#include "structured/optimise/webs.h"

#include <span>

namespace orb::structured {
namespace {

// Above these limits no robot has room for the program, and analysis would take long.
constexpr std::size_t most_lines = 16384;
constexpr std::size_t most_bits = std::size_t{1} << 27; ///< in sets of variables

bool is_huge(const Code& code) {
  return code.lines.size() > most_lines ||
         (code.lines.size() + code.routines.size()) * code.variables.size() > most_bits;
}

struct Pass {
  bool (*run)(Code&);
  std::uint32_t seen = none; ///< the number of changes when it last ran
};

/// Runs passes in turn until none of them changes anything.
void settle(Code& code, std::span<Pass> passes, std::uint32_t& changes) {
  constexpr int most_rounds = 12;
  auto before = none;
  for (int round = 0; round < most_rounds && changes != before; ++round) {
    before = changes;
    for (auto& pass : passes)
      if (pass.seen != changes) {
        pass.seen = changes;
        changes += pass.run(code) ? 1 : 0;
      }
  }
}

void shorten(Code& code) {
  Pass passes[] = {
      {clean_jumps},    {split_variables},
      {forward_values}, {drop_repeated},
      {merge_tails},    {inline_calls},
      {straighten},     {[](Code& one) { return use_values(one, BranchChanges::Split); }},
  };
  std::uint32_t changes = 0;
  clean_jumps(code);
  settle(code, passes, changes);
  // No pass replaces copies by originals after this point.
  changes += use_elements(code) ? 1 : 0;
  changes += compute_arms(code) ? 1 : 0; // from here on no branch depends on these numbers
  settle(code, passes, changes);
  clean_jumps(code);
}

} // namespace

void optimise(Code& code, Shape shape) {
  if (code.too_large)
    return; // it is cut off: labels are missing
  clean_jumps(code);
  code.too_large = is_huge(code);
  if (code.too_large)
    return;
  use_values(code);
  const auto wrong_indices = code.wrong_indices; // later passes drop some copies
  write_switches(code);
  if (shape == Shape::Shortest) // these move and join lines
    shorten(code);
  else
    clean_jumps(code);
  code.wrong_indices = wrong_indices;
  cut_prints(code);
}

} // namespace orb::structured
