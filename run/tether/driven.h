#pragma once

#include "run/live.h"
#include "run/tether/run_tethered.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <tl/expected.hpp>

namespace orb::run {

/// How long a run waits at most before it looks at its link again.
inline constexpr Duration longest_nap = 20ms;

/// Lets a run know what the robot says; its time is that of the link.
void feel(Live& live, const Said& said);

/// Brings a run to `t`, whatever it waits for.
void bring(Live& live, Duration t);

/// A run and the robot that it drives. All that is handed in outlives it.
class Driven {
public:
  Driven(Live& live, Tether& robot, Listener& listener, const TetherOptions& options)
      : live_(live), robot_(robot), listener_(listener), options_(options),
        origin_(robot.program_now()) {}

  /// Whether the run has more to do.
  enum class Course : std::uint8_t { GoesOn, Ends };
  /// Brings the run to the time of the link, sends what is due and waits a little for news; over a
  /// link that never waits it comes back at once. Fails where the robot cannot be driven on.
  tl::expected<Course, Failure> step();
  /// From now on the time of the program stands still: what the robot says is how it came to rest.
  void end();

  /// Takes what the robot says after the run.
  std::function<void(const Said&)> hear();
  /// How long nothing happens by itself.
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
  std::optional<Duration> paused_at_; ///< samples stay away, and the program waits with them
  bool over_ = false;
};

} // namespace orb::run
