#pragma once

#include "cli/context/context.h"
#include "cli/run/run_console.h"

#include <tl/expected.hpp>

namespace orb::cli {

/// True if the command line asks for a room: several balls in one world. A single program is not a
/// room.
bool is_room(const RunOptions& given);

/// Replaces rooms in `files` with the programs and courses that they name, each once. Errors in a
/// room are reported with their line.
tl::expected<std::vector<std::string>, Failure> open_rooms(const std::vector<std::string>& files);

/// Checks that all balls of a room can be where they start; its programs must be free of errors.
tl::expected<void, Failure> check_room(const Context& context, const std::string& file);

/// Runs all balls and reports how each one ended.
tl::expected<void, Failure> run_together(Context& context, const RunOptions& given);

} // namespace orb::cli
