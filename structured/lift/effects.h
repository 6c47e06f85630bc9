#pragma once

#include "structured/lift/ways.h"

#include <vector>

namespace orb::structured::lifting {

/// Whether computing a value can stop the program or changes what it reads.
bool acts(const compiler::Program& program, const compiler::Item& item);

/// By step of an `if`: both its sides are computed before one is looked at, and that shows.
std::vector<bool> prepared_tests(const compiler::Program& program, const Ways& ways);

} // namespace orb::structured::lifting
