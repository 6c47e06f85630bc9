#pragma once

#include "run/input.h"
#include "run/run.h"

#include <span>
#include <string>

namespace orb::run {

/// Explains an ending as far as the linter can, with the line to write: "line 20: `delay 2` waits 2
/// milliseconds; for 2 seconds, write `delay 2000`". Empty if the run ended as it should, or the
/// cause is unknown.
std::string why(std::span<const Input> inputs, const Ending& ending);

} // namespace orb::run
