#pragma once

#include "base/exit_code.h"
#include "vm/body/place.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// Who is in a room, where: a file such as room.toml, or a list of programs.

namespace orb::cli {

/// A ball of a room as its user writes it.
struct PlannedBall {
  std::string name;
  std::vector<std::string> files; ///< the first one runs; paths as from the working directory
  vm::Placement start;
  std::optional<std::uint64_t> seed;
  std::string robot;                ///< whose way of driving it has; empty for that of all
  std::vector<std::string> stimuli; ///< scripts or lines, for this ball alone
  std::string place;                ///< where it is written, `room.toml:4:1`; empty for a list
};

struct RoomPlan {
  std::string course; ///< empty for none
  std::vector<PlannedBall> balls;
};

/// Whether a file of that name is taken for a room.
bool is_room_file(std::string_view name);

/// Reads a room. What is wrong with it is told with its place.
tl::expected<RoomPlan, Failure> read_room(const std::string& path);

/// A ball for each program, named after its file. They stand side by side, in the order of their
/// names, and all face ahead. Two files of one name are refused.
tl::expected<RoomPlan, Failure> side_by_side(const std::vector<std::string>& files);

} // namespace orb::cli
