#pragma once

#include "compiler/text/program.h"

#include <string_view>

namespace orb::compiler {

/// Parses orbBasic source, or a program as it lies in the robot: the text ends at the first NUL.
/// Accepts what the robot accepts, which is more than `check` is content with: blanks may be
/// missing, lines may end in LF, CR or CRLF, `let` and unary minus are known. Total: any bytes give
/// a program; a line or a branch that does not parse holds the robot's error number, and `faults`
/// says why. `text` must outlive the program and be shorter than 2^31 bytes.
Program parse(std::string_view text);

} // namespace orb::compiler
