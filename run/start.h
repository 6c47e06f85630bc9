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

// How a run begins. run() starts it once and simulates the ball; a debugger keeps the freshly
// started ball.

namespace orb::run {

/// The programs and macros of all inputs, in order.
struct Load {
  struct ProgramOf {
    const Input* input;
    const Program* program;
  };
  std::vector<ProgramOf> programs;
  std::vector<const Macro*> macros;
};
Load load_of(std::span<const Input> inputs);

/// Returns the area for a program: the first goes where the options say, a second one to the other
/// area.
spec::Area area_of(std::size_t program, const Options& options);

/// Returns why the inputs cannot be run; nullopt if they can.
std::optional<Failure> objection(const Load& load);

/// Returns the ball's options, without observers.
vm::BallOptions ball_options(const Options& options);

/// Returns true if the first macro plays while it arrives.
bool streams(const Load& load);

/// Uploads everything as any client would. Ends at a whole second, so that trace times do not
/// depend on the duration of the upload.
tl::expected<void, Failure> upload(const Load& load, const Options& options, vm::Ball& ball,
                                   uploader::Session& session);

/// Result of a start without a client. With a client, the ball's answer tells.
enum class Started : std::uint8_t { Yes, Refused };

/// Schedules the effects of the world and starts the program or macro.
Started start(const Load& load, const Options& options, vm::Ball& ball, uploader::Session& session);

/// Returns why the ball does not start the program or macro.
Failure refusal(const Load& load, const Options& options);

/// Adds the files to the journey and maps robot lines and commands to places in them.
void describe(std::span<const Input> inputs, const Options& options, report::Journey& journey);

} // namespace orb::run
