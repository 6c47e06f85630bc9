#include "structured/optimise/optimise.h"

#include "structured/optimise/arms.h"
#include "structured/optimise/elements.h"
#include "structured/optimise/forward.h"
#include "structured/optimise/inline.h"
#include "structured/optimise/jumps.h"
#include "structured/optimise/long_prints.h"
#include "structured/optimise/repeated.h"
#include "structured/optimise/switches.h"
#include "structured/optimise/tails.h"
#include "structured/optimise/values.h"
#include "structured/optimise/webs.h"

#include <span>

namespace orb::structured {
namespace {

// Beyond these no robot holds the program, and looking at it would take long.
constexpr std::size_t most_lines = 16384;
constexpr std::size_t most_bits = std::size_t{1} << 27; ///< of sets of variables

bool is_huge(const Code& code) {
  return code.lines.size() > most_lines ||
         (code.lines.size() + code.routines.size()) * code.variables.size() > most_bits;
}

struct Pass {
  bool (*run)(Code&);
  std::uint32_t seen = none; ///< how much had been changed when it last ran
};

/// Runs passes in turn until none of them, seeing what all others have done, changes anything.
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
      {straighten},     {[](Code& one) { return use_values(one, Ways::Split); }},
  };
  std::uint32_t changes = 0;
  clean_jumps(code);
  settle(code, passes, changes);
  // Nothing is left that reads the original instead.
  changes += use_elements(code) ? 1 : 0;
  changes += compute_arms(code) ? 1 : 0; // no way is known by these numbers any more
  settle(code, passes, changes);
  clean_jumps(code);
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
  if (shape == Shape::Shortest) // these move and join lines
    shorten(code);
  else
    clean_jumps(code);
  code.wrong_indices = wrong_indices;
  cut_prints(code);
}

} // namespace orb::structured
