#pragma once

#include "protocol/transport.h"
#include "spec/ball.h"
#include "vm/ball.h"
#include "vm/robot_v2.h"

#include <deque>

namespace orb::vm {

/// Timing of the wire between a client and a ball in the same process.
struct WireModel {
  Duration round_trip{}; ///< half of it in each direction
  std::uint32_t bytes_per_second =
      spec::ball::wire_bytes_per_second; ///< to the ball; the ball paces its own output
};

/// The link `sim:`: a client's end of a wire to a ball in this process. Time is virtual: waiting
/// costs nothing, and the ball advances exactly as long as the client waits.
class BallTransport final : public protocol::Transport {
public:
  /// Connects to the ball, which must outlive the transport.
  explicit BallTransport(Ball& ball, const WireModel& wire = {});
  /// Connects to a robot with packets v2. `ball` is the robot's body.
  BallTransport(Ball& ball, RobotV2& robot, const WireModel& wire = {});
  ~BallTransport() override;
  BallTransport(const BallTransport&) = delete;
  BallTransport& operator=(const BallTransport&) = delete;

  Instant now() const override { return ball_.now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  /// Returns nothing if the deadline is `never` and the ball is at rest.
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

private:
  struct Lump {
    Instant due;
    Bytes bytes;
  };

  void exchange();
  Bytes take_output();

  Ball& ball_;
  RobotV2* robot_ = nullptr;
  WireModel wire_;
  Instant wire_free_{};
  std::deque<Lump> to_ball_;
  std::deque<Lump> to_client_;
};

} // namespace orb::vm
