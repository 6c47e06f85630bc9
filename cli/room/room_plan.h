#pragma once

#include "base/exit_code.h"
#include "vm/body/place.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// The balls of a room and their places, from a file such as room.toml or from a list of programs.

namespace orb::cli {

/// A ball of a room as the user describes it.
struct PlannedBall {
  std::string name;
  std::vector<std::string> files; ///< the first one runs; relative to the working directory
  vm::Placement start;
  std::optional<std::uint64_t> seed;
  std::string robot;                ///< model that it drives like; empty for the common one
  std::vector<std::string> stimuli; ///< scripts or lines for this ball only
  std::string place;                ///< its place in the file, `room.toml:4:1`; empty for a list
};

struct RoomPlan {
  std::string course; ///< empty for none
  std::vector<PlannedBall> balls;
};

/// True if the name is that of a room file.
bool is_room_file(std::string_view name);

/// Reads a room. Errors include their place.
tl::expected<RoomPlan, Failure> read_room(const std::string& path);

/// Makes a ball for each program, named after its file. They are placed side by side in order of
/// name and face ahead. Fails for two files with the same name.
tl::expected<RoomPlan, Failure> side_by_side(const std::vector<std::string>& files);

} // namespace orb::cli
