#pragma once

#include "run/live.h"
#include "run/tether/run_tethered.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <tl/expected.hpp>

namespace orb::run {

/// The longest wait of a run before it polls its link.
inline constexpr Duration longest_nap = 20ms;

/// Passes news from the robot to a run; the run's time is that of the link.
void feel(Live& live, const RobotMessage& said);

/// Advances a run to `t`, whatever it waits for.
void bring(Live& live, Duration t);

/// A run and the robot it drives. All arguments must outlive it.
class Driven {
public:
  Driven(Live& live, Tether& robot, Listener& listener, const TetherOptions& options)
      : live_(live), robot_(robot), listener_(listener), options_(options),
        origin_(robot.program_now()) {}

  /// GoesOn: the run has more to do.
  enum class Progress : std::uint8_t { GoesOn, Ends };
  /// Advances the run to the time of the link, sends what is due and waits briefly for news;
  /// returns at once on a link that never waits. Fails if the robot can no longer be driven.
  tl::expected<Progress, Failure> step();
  /// Stops the program's time: later samples show how the robot came to rest.
  void end();

  /// Returns a handler for news after the run.
  std::function<void(const RobotMessage&)> hear();
  /// The time until the next event.
  Duration nap() const;

private:
  Duration elapsed() const { return robot_.program_now() - origin_; }
  void note(decltype(DriveLine::what) what);
  tl::expected<void, Failure> sit_out();

  Live& live_;
  Tether& robot_;
  Listener& listener_;
  const TetherOptions& options_;
  Instant origin_;
  std::optional<Duration> paused_at_; ///< samples are missing, and the program waits for them
  bool over_ = false;
};

} // namespace orb::run
