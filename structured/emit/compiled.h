#pragma once

#include "compiler/text/image.h"
#include "structured/emit/letter_allocation.h"
#include "structured/emit/print.h"
#include "structured/lower/code.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <algorithm>

namespace orb::structured {

/// A structured program with all its findings and, if it has no errors, the robot's lines.
struct Compiled {
  Program program;
  Names names;
  Code code;
  LetterAllocation letters;
  RobotText robot;         ///< empty on errors, or if there is nothing to run
  compiler::Program lines; ///< the same, parsed: for take_lines(), since their text moves with this
  compiler::Image image;   ///< the same, packed
  bool runs = false;       ///< true if there is a program to run

  /// True if an error prevents building.
  bool has_errors() const {
    return std::any_of(program.diagnostics.begin(), program.diagnostics.end(), keeps_from_building);
  }
};

} // namespace orb::structured
