#pragma once

#include "cli/link.h"
#include "compiler/image.h"

#include <map>
#include <string>

namespace orb::cli {

/// Where the robot's lines come from, so that its errors can point into a source file.
struct LineMap {
  std::string file;
  std::map<std::uint32_t, std::uint32_t> source_line; ///< by the robot's line number
};

LineMap line_map(const std::string& file, const compiler::Image& image);

/// Reads a map that `orb build --map` wrote; the error is a sentence.
tl::expected<LineMap, std::string> read_line_map(const std::string& path);

/// What was seen of a program that runs.
struct Watched {
  bool faulted = false;
  bool lost = false; ///< the link ended by itself
};

/// Prints what comes from the ball until Ctrl-C, or until the built-in ball is at rest: prints to
/// stdout as they are, markers, collisions and sensor values a line each; errors to stderr.
Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const LineMap& lines);

} // namespace orb::cli
