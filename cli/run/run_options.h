#pragma once

#include "cli/context/context.h"
#include "cli/run/run_console.h"
#include "run/run.h"

#include <tl/expected.hpp>

namespace orb::cli {

/// What the words of the command line of `orb run` mean.
tl::expected<run::Options, Failure> read_options(const Context& context, const RunOptions& given);

} // namespace orb::cli
