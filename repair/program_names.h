#pragma once

#include "repair/repair.h"

namespace orb::repair {

/// Like offer_lines(), for a numbered program, but first applies changes to the whole program:
/// multi-letter names become free letters, labels become line numbers, and several statements on a
/// line become separate lines. The other lines are repaired in the program that results.
void offer_program(std::string_view text, const Dialect& dialect,
                   std::vector<Diagnostic>& findings);

} // namespace orb::repair
