#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "vm/ball.h"
#include "vm/robot_v2.h"

#include <optional>

namespace orb::vm {

/// A robot as its clients see it: bytes in, packets out, v1 or v2 depending on the robot. The
/// caller advances the time.
class Device {
public:
  /// `options.robot` selects the robot.
  explicit Device(const BallOptions& options);
  /// Copies the device with all its state. The copy reports to `observer`, which may be null.
  Device(const Device& other, Observer* observer);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void connect();
  void disconnect();
  /// Takes bytes from the client, at now().
  void receive(ByteView bytes);
  /// Returns the oldest whole packet that has left; nullopt if there is none.
  std::optional<Bytes> take_packet();

  Instant now() const { return ball_.now(); }
  /// Runs everything that is due up to and including `target`.
  void advance_to(Instant target, Ball::Halt halt = Ball::Halt::Look);
  /// The next event, including packets that leave; `never` at rest.
  Instant next_event() const;

  /// Returns true while it sleeps. A robot with packets v2 still answers then.
  bool asleep() const { return v2_ ? !v2_->awake() : ball_.asleep(); }
  Ball& ball() { return ball_; }
  const Ball& ball() const { return ball_; }

private:
  Ball ball_;
  std::optional<RobotV2> v2_; ///< only for robots with packets v2
};

} // namespace orb::vm
