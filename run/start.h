#pragma once

#include "report/journey.h"
#include "run/input.h"
#include "run/run.h"
#include "uploader/session.h"
#include "vm/ball.h"

#include <optional>
#include <span>
#include <tl/expected.hpp>
#include <vector>

// How a run begins: run() does it once and lets the ball live, a debugger keeps the ball that has
// just begun.

namespace orb::run {

/// The programs and macros of all inputs, in their order.
struct Load {
  struct ProgramOf {
    const Input* input;
    const Program* program;
  };
  std::vector<ProgramOf> programs;
  std::vector<const Macro*> macros;
};
Load load_of(std::span<const Input> inputs);

/// Where the programs go: the first to where the options say, a second one to the other area.
spec::Area area_of(std::size_t program, const Options& options);

/// That the inputs cannot be run; nothing where they can.
std::optional<Failure> objection(const Load& load);

/// The ball that the options ask for; nobody watches it yet.
vm::BallOptions ball_options(const Options& options);

/// Whether the first macro plays while it arrives.
bool streams(const Load& load);

/// Brings everything into the ball the way any client would. It ends at a whole second, so that
/// times in a trace do not depend on how long that took.
tl::expected<void, Failure> upload(const Load& load, const Options& options, vm::Ball& ball,
                                   uploader::Session& session);

/// What a start without a client came to; with one, the answer tells.
enum class Started : std::uint8_t { Yes, Refused };

/// Lets the world act from now on, and starts the program or the macro.
Started start(const Load& load, const Options& options, vm::Ball& ball, uploader::Session& session);

/// Why the ball does not start what it was given.
Failure refusal(const Load& load, const Options& options);

/// Tells the journey which files there are and where the robot's lines and commands stand in them.
void describe(std::span<const Input> inputs, const Options& options, report::Journey& journey);

} // namespace orb::run
