#pragma once

#include "playground/engine/request.h"

namespace orb::playground {

/// Runs test files and judges them.
Answer test(Request& request);

/// One case of a test once more, with what a player shows of it.
Answer replay(Request& request);

} // namespace orb::playground
