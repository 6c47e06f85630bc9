#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/decoder.h"
#include "protocol/packet_v2.h"
#include "spec/robots.h"
#include "vm/ball.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace orb::vm {

/// A virtual robot of packets v2: a ball whose clients speak these. It holds no physics and no
/// lamps of its own; what a client asks it asks the ball, and what the ball feels it says. It
/// answers while it sleeps, but drives and shines only once it has been woken.
class RobotV2 {
public:
  /// `ball` must outlive it; the time is the ball's.
  RobotV2(Ball& ball, spec::Robot robot, std::string address);

  /// A client has come; nothing is known of it yet.
  void connect();
  void disconnect();
  /// Bytes from the client, at the ball's now().
  void receive(ByteView bytes);
  /// What is due by the ball's now() happens. To be called after the ball has been advanced.
  void run();
  /// When run() is due next; `never` while nothing happens by itself.
  Instant next_event() const;
  /// A whole packet that leaves, oldest first.
  std::optional<Bytes> take_packet();

private:
  struct Service {
    const spec::V2ServiceInfo* row;
    int bits;
  };
  /// A stream of an RVR's processor.
  struct Services {
    std::uint8_t token = 0;
    std::vector<Service> services;
    Duration period{};
    Instant next = never;
  };

  void obey(const protocol::PacketV2& request);
  spec::V2Error perform(const protocol::PacketV2& request, Bytes& answer);
  spec::V2Error perform(spec::V2Command command, const protocol::PacketV2& request, Bytes& answer);
  spec::V2Error set_lamps(std::uint32_t mask, ByteView values);
  spec::V2Error set_motors(ByteView data);
  spec::V2Error configure(const protocol::PacketV2& request);
  void drive(ByteView data);
  void fall_asleep();
  void stop_streams();
  void start_mask();
  void ask_ball(spec::ApiCommand command, Bytes data);
  void say(spec::V2Message message, spec::V2Processor processor, Bytes data);
  void say_sample();
  void say_services(Services& stream, spec::V2Processor processor);
  double sense(spec::V2Sensor sensor) const;
  std::vector<double> sense(spec::V2Service service) const;
  Services& services_of(const protocol::PacketV2& request);
  void hear_ball();

  Ball& ball_;
  const spec::RobotInfo& robot_;
  std::string address_;
  protocol::DecoderV2 decoder_;
  protocol::Decoder from_ball_{protocol::Direction::FromBall};
  std::deque<Bytes> out_;
  bool awake_ = false;
  Instant drives_until_ = never;
  std::array<std::uint8_t, 32> lamps_{};

  Duration interval_{};
  int left_ = 0; ///< samples to come; 0: endless
  std::uint32_t mask_ = 0;
  std::uint32_t extended_ = 0;
  Instant next_sample_ = never;
  Services first_;
  Services second_;
};

} // namespace orb::vm
