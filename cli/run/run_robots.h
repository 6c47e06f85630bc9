#pragma once

#include "cli/run/run_console.h"

#include <functional>

namespace orb::cli {

/// Runs a program with one robot as its body, or with several at once; `run_one` runs it with the
/// robot at `port` in its options. Output files get the robot's name if there are several.
void run_on_robots(Context& context, const RunOptions& options,
                   const std::function<void(Context&, RunOptions&)>& run_one);

} // namespace orb::cli
