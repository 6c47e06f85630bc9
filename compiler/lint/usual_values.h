#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/analyse/range.h"
#include "compiler/text/program.h"
#include "spec/basic.h"

#include <array>
#include <optional>

namespace orb::compiler {

/// By variable of the system: the values that it usually has while a program drives.
using UsualValues = std::array<std::optional<Range>, spec::variables.size()>;

/// Finds the usual values of places, times, `accelone` and `Vbatt`, unless the program compares
/// them, or what it computes from them: then it may know their values.
UsualValues usual_values(const Program& program, const Flow& flow);

} // namespace orb::compiler
