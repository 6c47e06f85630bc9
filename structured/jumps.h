#pragma once

#include "structured/code.h"

namespace orb::structured {

/// Leads jumps to jumps where they end, takes out lines that nothing reaches, jumps to the next
/// line and labels that nothing names. Keeps what the program does.
void clean_jumps(Code& code);

} // namespace orb::structured
