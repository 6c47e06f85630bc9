#pragma once

#include "report/journey.h"
#include "run/input.h"
#include "run/run.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

// Several balls in one world, each with its own program.

namespace orb::run {

/// One ball of a room. Everything it refers to must outlive the run.
struct RoomBall {
  std::string name; ///< unique in the room
  std::span<const Input> inputs;
  Options options; ///< starting place and seed; bound and slice are the same for all balls
  Listener* listener = nullptr;
  report::Journey* journey = nullptr; ///< may be null
};

/// A ball that starts inside another one, or in a wall.
struct Clash {
  std::size_t ball = 0;
  std::optional<std::size_t> other; ///< index of the earlier ball it overlaps
  std::optional<vm::Wall> wall;
  double apart_cm = 0; ///< between the centres, or to the wall
};

/// Returns the clashes in order, at most one per ball.
std::vector<Clash> clashes(std::span<const RoomBall> balls);

/// Returns the default seed of a ball. It depends on the name, so that equal programs do not draw
/// equal numbers.
std::uint64_t seed_of(std::uint64_t run, std::string_view name);

/// Runs all programs in one world until none runs, or a ball has printed the sought text, or all
/// listeners have had enough. Returns the endings in the order of the balls; that order does not
/// affect results. Each listener receives events of its own ball, and on_time() once the others
/// have come as far. If any ball has Steps::Heard, all take their steps together, and listeners are
/// called once all have taken a step. Fails if a ball rejects an upload, or a macro would have to
/// be streamed.
tl::expected<std::vector<Ending>, Failure> run_room(std::span<const RoomBall> balls);

} // namespace orb::run
