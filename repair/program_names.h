#pragma once

#include "repair/repair.h"

namespace orb::repair {

/// Like offer_lines(), for a numbered program: what takes all of its lines is mended first. Names
/// of several letters become free letters, labels the numbers of their lines, and statements with
/// numbers of their own lines of their own; the other lines are looked at in the program that this
/// makes.
void offer_program(std::string_view text, const Dialect& dialect,
                   std::vector<Diagnostic>& findings);

} // namespace orb::repair
