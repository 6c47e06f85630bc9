#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/decoder.h"
#include "protocol/packet_v2.h"
#include "spec/robots.h"
#include "vm/ball.h"
#include "vm/matrix.h"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace orb::vm {

/// A virtual robot with packets v2: an adapter from these to a ball. It holds no physics and no
/// lamps; it forwards requests to the ball and reports what the ball senses. It answers while
/// asleep, but drives and shines only once woken. Large because it holds everything that a client
/// can set, stream or subscribe to on any of the robots.
class RobotV2 {
public:
  /// `ball` must outlive it and supplies the time.
  RobotV2(Ball& ball, spec::Robot robot, std::string address);
  /// Copies the robot for a copy of its ball.
  RobotV2(const RobotV2& other, Ball& ball);

  /// Returns true once woken. While asleep it answers but neither drives nor shines.
  bool awake() const { return awake_; }
  /// A client connects with fresh state.
  void connect();
  void disconnect();
  /// Takes bytes from the client, at the ball's now().
  void receive(ByteView bytes);
  /// Runs what is due by the ball's now(). To be called after the ball has been advanced.
  void run();
  /// When run() is due next; `never` if nothing is pending.
  Instant next_event() const;
  /// Returns the oldest whole packet that leaves.
  std::optional<Bytes> take_packet();

private:
  RobotV2(const RobotV2&) = default;

  struct Service {
    const spec::V2ServiceInfo* row;
    int bits;
  };
  /// The streams of one processor of an RVR: several tokens, one period.
  struct Services {
    std::map<std::uint8_t, std::vector<Service>> tokens;
    Duration period{};
    Instant next = never;
  };
  /// Notifications enabled by the client.
  struct Wishes {
    bool collisions = true;
    bool sensed_collisions = false; ///< in the format of a BOLT+
    bool battery = false;
    bool charger = false;
    bool gyro_max = false;
    bool voltage = false;
  };

  void obey(const protocol::PacketV2& request);
  spec::V2Error perform(const protocol::PacketV2& request, Bytes& answer);
  spec::V2Error perform(spec::V2Command command, const protocol::PacketV2& request, Bytes& answer);
  spec::V2Error set_lamps(std::uint32_t mask, ByteView values);
  spec::V2Error set_collisions(ByteView data);
  spec::V2Error set_motors(ByteView data);
  spec::V2Error configure(const protocol::PacketV2& request);
  void reset_locator();
  void drive(ByteView data);
  void fall_asleep();
  void stop_streams();
  void start_mask();
  void ask_ball(spec::ApiCommand command, Bytes data);
  void say(spec::V2Message message, spec::V2Processor processor, Bytes data);
  void say_soon(spec::V2Message message, spec::V2Processor processor, Bytes data);
  Bytes message(spec::V2Message message, spec::V2Processor processor, Bytes data) const;
  spec::V2Error save_animation(ByteView data);
  void watch_matrix();
  void watch_charger();
  void watch_rotation();
  std::uint8_t voltage_state() const;
  std::uint8_t charger_state() const;
  std::string name() const;
  bool is_awake_enough() const { return awake_ && ball_->now() >= moves_from_; }
  void stay_awake();
  void say_sample();
  void say_services(Services& stream, spec::V2Processor processor);
  double sense(spec::V2Sensor sensor) const;
  std::vector<double> sense(spec::V2Service service) const;
  Services& services_of(const protocol::PacketV2& request);
  void hear_ball();

  Ball* ball_;
  const spec::RobotInfo& robot_;
  std::string address_;
  protocol::DecoderV2 decoder_;
  protocol::Decoder from_ball_{protocol::Direction::FromBall};
  std::deque<Bytes> out_;
  std::deque<std::pair<Instant, Bytes>> soon_; ///< messages that follow an answer
  bool awake_ = false;
  bool has_slept_ = false;
  Instant moves_from_{};      ///< drops drive commands until then
  Instant sleeps_at_ = never; ///< if no packet arrives
  bool said_will_sleep_ = false;
  Instant hangs_up_at_ = never; ///< asleep, unless it is woken
  Wishes wishes_;
  bool was_charging_ = false;
  bool was_turning_fast_ = false;
  std::uint8_t was_voltage_state_ = 0;
  std::string name_; ///< set by a client
  double head_deg_ = 0;
  std::uint8_t legs_ = 2;
  double leg_ = 0; ///< the third one
  std::uint8_t volume_ = UINT8_MAX;
  Instant drives_until_ = never;
  std::array<std::uint8_t, 32> lamps_{};
  Matrix matrix_; ///< stays dark on robots without a matrix
  Matrix::Pixels shown_{};
  std::optional<std::uint8_t> plays_; ///< the animation that plays; nullopt: a text

  Duration interval_{};
  int left_ = 0; ///< samples left; 0: endless
  std::uint32_t mask_ = 0;
  std::uint32_t extended_ = 0;
  Instant next_sample_ = never;
  Services first_;
  Services second_;
};

} // namespace orb::vm
