#pragma once

#include "base/bytes.h"
#include "run/tether/streamed.h"
#include "spec/robots.h"
#include "vm/body/remote_body.h"
#include "vm/common/observer.h"
#include "vm/stimulus.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace orb::run {

/// A message from a robot.
struct RobotMessage {
  /// The answer to a request.
  struct Answer {
    std::uint8_t seq = 0;
    std::uint8_t error = 0; ///< 0: done
    Bytes data;
  };
  struct WillSleep {}; ///< unless it receives a request
  std::variant<Answer, vm::Sample, vm::event::Collision, vm::stimulus::Battery, WillSleep> what;
};

/// A request without its sequence number.
struct Request {
  std::uint8_t did = 0;
  std::uint8_t cid = 0;
  Bytes data;
  /// Try: the run continues even if the robot refuses the request.
  enum class Need : std::uint8_t { Must, Try };
  Need need = Need::Must;
};

/// Zero: a run begins by setting the robot's heading and place to 0.
enum class Aim : std::uint8_t { Zero, Keep };

/// Collision detection: per axis a threshold and its increase at full speed.
struct CollisionLimits {
  int threshold = 32; ///< 1..255. Source: LIB, the lowest in use; 100 misses a wall hit at speed 40
  int speed = 32;     ///< 0..255

  /// The operands of `configure-collision-detection`, the same in v1 and v2.
  Bytes operands() const;
  static Bytes off() { return Bytes(6, 0); }
};

/// Parses a collision message of 16 or 18 bytes, with the speed after two powers (API v1) or three
/// (v2); nullopt for other sizes.
std::optional<vm::event::Collision> read_collision(ByteView data, std::size_t speed_at);

/// Translates requests to a robot's packets, and its packets to values. Knows no time and sends
/// nothing.
class RobotWire {
public:
  virtual ~RobotWire() = default;

  virtual Bytes encode(const Request& request, std::uint8_t seq) const = 0;
  virtual std::uint8_t next_seq(std::uint8_t seq) const = 0;
  /// Copies the bytes. Messages not yet taken by next() stay available.
  virtual void feed(ByteView bytes) = 0;
  virtual std::optional<RobotMessage> next() = 0;

  /// Requests that prepare it for a run, in order. hear_setup() takes their answers; nullopt for a
  /// refusal.
  virtual std::vector<Request> setup(Aim aim) const = 0;
  virtual void hear_setup(const Request& request, const std::optional<Bytes>& answer) = 0;
  /// Further requests that depend on the answers to setup().
  virtual std::vector<Request> setup_more() const { return {}; }
  /// Requests that start streaming, and that stop it.
  virtual std::vector<Request> stream(const Streamed& streamed) = 0;
  virtual std::vector<Request> silence() const = 0;
  /// Requests that undo setup(), after the robot has been stopped and silenced.
  virtual std::vector<Request> teardown() const = 0;

  /// Returns nullopt for what the robot cannot do.
  virtual std::optional<Request> drive(const vm::Motion& motion) const = 0;
  virtual Request brake(int heading_deg) const = 0;
  virtual std::vector<Request> show(vm::Color color) const = 0;
  virtual std::optional<Request> show_back(int level) const = 0;

  /// How long the robot ignores drive commands after this request of setup().
  virtual Duration rests_after(const Request&) const { return {}; }
  /// A request for the battery voltage or, if the robot does not report it, one that keeps it
  /// awake. read_battery() parses the answer.
  virtual Request ask_battery() const = 0;
  virtual std::optional<vm::stimulus::Battery> read_battery(const Bytes& answer) const = 0;

  /// Returns true if the request switches stabilization off: the robot then ignores rolls until it
  /// is on again.
  virtual bool loosens(const Request& request) const = 0;

  virtual Duration interval() const = 0;
  /// Returns for example `drive-with-heading (16h 07h)`.
  std::string name_of(const Request& request) const;
  /// Returns the meaning of an error code in the robot's tables: `busy`, `bad length`.
  virtual std::string describe(std::uint8_t error) const = 0;
  virtual bool means_later(std::uint8_t error) const = 0;

private:
  /// As in its row; empty if there is none.
  virtual std::string_view command_name(const Request& request) const = 0;
};

std::unique_ptr<RobotWire> make_wire(spec::Robot robot, CollisionLimits limits = {});

} // namespace orb::run
