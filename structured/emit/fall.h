#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Takes out jumps over tests that would lead to the same place: the line above such a jump can
/// then stand in the test before it. The opposite of what threading does, so it comes last.
void fall_through_tests(Code& code);

} // namespace orb::structured
