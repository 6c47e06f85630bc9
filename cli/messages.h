#pragma once

#include "cli/link.h"
#include "run/line_map.h"

namespace orb::cli {

/// What was seen of a program that runs.
struct Watched {
  bool faulted = false;
  bool lost = false; ///< the link ended by itself
};

/// Prints what comes from the ball until Ctrl-C, or until the built-in ball is at rest: prints to
/// stdout as they are, markers, collisions and sensor values a line each; errors to stderr.
Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const run::LineMap& lines);

} // namespace orb::cli
