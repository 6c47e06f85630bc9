#pragma once

#include "playground/engine/request.h"

// Requests about sources that do not run them.

namespace orb::playground {

Answer check(Request& request);
Answer format(Request& request);
Answer build(Request& request);
Answer assemble(Request& request);
Answer tree(Request& request);
Answer words(Request& request);
Answer lift(Request& request);

} // namespace orb::playground
