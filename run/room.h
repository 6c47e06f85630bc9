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

// A room: several balls in one world, each with a program of its own.

namespace orb::run {

/// One ball of a room. What it refers to outlives the run.
struct RoomBall {
  std::string name; ///< no other ball has it
  std::span<const Input> inputs;
  Options options; ///< where it starts, its seed; bound and slice are the same for all balls
  Listener* listener = nullptr;
  report::Journey* journey = nullptr; ///< may be null
};

/// A ball that starts inside another one, or in a wall.
struct Clash {
  std::size_t ball = 0;
  std::optional<std::size_t> other; ///< the one before it that it is in
  std::optional<vm::Wall> wall;
  double apart_cm = 0; ///< from middle to middle, or to the wall
};

/// Those of a list, in its order; one for each ball at most.
std::vector<Clash> clashes(std::span<const RoomBall> balls);

/// The seed of a ball that is given none: its own for each name, so that equal programs do not draw
/// equal numbers.
std::uint64_t seed_of(std::uint64_t run, std::string_view name);

/// Runs all programs in one world, until none runs any more, or one ball has printed what is looked
/// for, or all listeners have had enough. The endings are those of the balls, in their order; that
/// order changes nothing. Each listener hears of its own ball, and by on_time() that the others
/// have come as far. With Steps::Heard for any ball all take their steps together, and listeners
/// hear of a step when all have taken it. Fails where a ball does not take what it is given, or
/// where a macro would play while it arrives.
tl::expected<std::vector<Ending>, Failure> run_room(std::span<const RoomBall> balls);

} // namespace orb::run
