#pragma once

#include "structured/emit/letter_allocation.h"
#include "structured/lower/code.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Turns tests and the lines they lead to into the robot's `if … then … else`: joins tests with its
/// single `and` or `or`, places single statements after `then` and `else`, and uses only
/// comparisons that it has. Removes copies between variables that share a letter. Afterwards no If
/// lines remain, and a robot line that can stop the program belongs to one source line.
void write_choices(Code& code, const LetterAllocation& letters, const Program& program);

} // namespace orb::structured
