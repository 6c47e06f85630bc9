#pragma once

#include "cli/context/context.h"
#include "cli/run/run_console.h"
#include "run/run.h"

#include <tl/expected.hpp>

namespace orb::cli {

/// Interprets the options of `orb run`.
tl::expected<run::Options, Failure> read_options(const Context& context, const RunOptions& given);

} // namespace orb::cli
