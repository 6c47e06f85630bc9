#pragma once

#include "compiler/text/image.h"
#include "structured/emit/letters.h"
#include "structured/emit/print.h"
#include "structured/lower/code.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <algorithm>

namespace orb::structured {

/// A structured program, all that is to be said about it, and, where no error was found, the lines
/// of the robot that it becomes.
struct Compiled {
  Program program;
  Names names;
  Code code;
  Letters letters;
  RobotText robot;         ///< empty where there are errors, or nothing to run
  compiler::Program lines; ///< these, parsed: for take_lines(), as their text moves with this
  compiler::Image image;   ///< of these, packed
  bool runs = false;       ///< whether there is a program to run

  /// Whether something keeps it from becoming lines.
  bool has_errors() const {
    return std::any_of(program.diagnostics.begin(), program.diagnostics.end(), keeps_from_building);
  }
};

} // namespace orb::structured
