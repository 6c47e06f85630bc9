#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Writes what is left of `select` as tests, each before the lines it leads to; a choice among
/// calls becomes the robot's `on … gosub`.
void write_switches(Code& code);

} // namespace orb::structured
