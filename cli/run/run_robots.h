#pragma once

#include "cli/run/run_console.h"

#include <functional>

namespace orb::cli {

/// Runs the same program with one robot as its body, or with several at once; `run_one` runs it
/// with the robot at `port` of its options. Files that each robot would write have its name.
void run_on_robots(Context& context, const RunOptions& options,
                   const std::function<void(Context&, RunOptions&)>& run_one);

} // namespace orb::cli
