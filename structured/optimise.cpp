#include "structured/optimise.h"

#include "structured/forward.h"
#include "structured/jumps.h"
#include "structured/long_prints.h"
#include "structured/switches.h"
#include "structured/values.h"

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

void optimise(Code& code) {
  clean_jumps(code);
  code.too_large = code.too_large || is_huge(code);
  if (code.too_large)
    return;
  use_values(code);
  write_switches(code);
  clean_jumps(code);
  forward_values(code);
  cut_prints(code);
}

} // namespace orb::structured
