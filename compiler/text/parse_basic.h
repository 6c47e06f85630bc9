#pragma once

#include "compiler/text/program.h"

#include <string_view>

namespace orb::compiler {

/// Parses orbBasic source, or a program as stored in the robot: the text ends at the first NUL.
/// Accepts what the robot accepts, which is more than `check` allows: spaces may be missing, lines
/// may end in LF, CR or CRLF, and `let` and unary minus are known. Any bytes give a program: a line
/// or a branch that does not parse stores the robot's error number, and `faults` gives the reason.
/// `text` must outlive the program and be shorter than 2^31 bytes.
Program parse(std::string_view text);

} // namespace orb::compiler
