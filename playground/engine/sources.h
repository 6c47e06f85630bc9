#pragma once

#include "playground/engine/request.h"

// What is asked about sources without running them.

namespace orb::playground {

Answer check(Request& request);
Answer format(Request& request);
Answer build(Request& request);
Answer assemble(Request& request);

} // namespace orb::playground
