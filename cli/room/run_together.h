#pragma once

#include "cli/context/context.h"
#include "cli/run/run_console.h"

#include <tl/expected.hpp>

namespace orb::cli {

/// Whether the command line asks for a room: several balls in one world. One program alone is none.
bool is_room(const RunOptions& given);

/// The files that rooms among `files` speak of, each once, in place of them: programs and courses.
/// What is wrong with a room is told at its line.
tl::expected<std::vector<std::string>, Failure> open_rooms(const std::vector<std::string>& files);

/// Whether all balls of a room whose programs are without errors can stand where they start.
tl::expected<void, Failure> check_room(const Context& context, const std::string& file);

/// Runs all its balls and tells how each one ended.
tl::expected<void, Failure> run_together(Context& context, const RunOptions& given);

} // namespace orb::cli
