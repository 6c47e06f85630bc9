#pragma once

#include "structured/lift/control_flow.h"

#include <vector>

namespace orb::structured::lifting {

/// True if computing a value can stop the program or has side effects.
bool acts(const compiler::Program& program, const compiler::Item& item);

/// By step of an `if`: true if it matters that both sides are computed before one is tested.
std::vector<bool> prepared_tests(const compiler::Program& program, const ControlFlow& ways);

} // namespace orb::structured::lifting
