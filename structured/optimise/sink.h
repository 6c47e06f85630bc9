#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// `if … then v = a else v = b` before a short line, the only one that reads v: that line stands in
/// both branches.
void sink_into_arms(Code& code);

} // namespace orb::structured
