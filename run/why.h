#pragma once

#include "run/input.h"
#include "run/run.h"

#include <span>
#include <string>

namespace orb::run {

/// Why a run came to what was seen of it, as far as the linter knows, with the line to write:
/// "line 20: `delay 2` waits 2 milliseconds; for 2 seconds, write `delay 2000`". Empty where it
/// ended as it should, or nobody knows.
std::string why(std::span<const Input> inputs, const Ending& ending);

} // namespace orb::run
