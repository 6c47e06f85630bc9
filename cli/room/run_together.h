#pragma once

#include "cli/context/context.h"
#include "cli/run/run_console.h"

#include <tl/expected.hpp>

namespace orb::cli {

/// Whether the command line asks for a room: several balls in one world. One program alone is none.
bool is_room(const RunOptions& given);

/// Runs all its balls and tells how each one ended.
tl::expected<void, Failure> run_together(Context& context, const RunOptions& given);

} // namespace orb::cli
