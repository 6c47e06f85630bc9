#pragma once

#include "structured/emit/letters.h"
#include "structured/lower/code.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Turns tests and the lines they lead to into the robot's `if … then … else`: tests joined by its
/// one `and` or `or`, single statements after `then` and `else`, comparisons that it has. Copies
/// between variables that share a letter go. Afterwards there are no If lines. A robot's line has
/// one line of the source where it can stop the program.
void write_choices(Code& code, const Letters& letters, const Program& program);

} // namespace orb::structured
