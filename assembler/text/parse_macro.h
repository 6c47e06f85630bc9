#pragma once

#include "assembler/text/program.h"

#include <string_view>

namespace orb::assembler {

/// Parses macro source. Accepts any bytes; always returns a program and its findings.
Program parse(std::string_view text);

} // namespace orb::assembler
