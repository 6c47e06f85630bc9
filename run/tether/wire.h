#pragma once

#include "base/bytes.h"
#include "run/tether/streamed.h"
#include "spec/robots.h"
#include "vm/body/elsewhere.h"
#include "vm/observer.h"
#include "vm/stimulus.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace orb::run {

/// What a robot has said.
struct Said {
  /// To a request.
  struct Answer {
    std::uint8_t seq = 0;
    std::uint8_t error = 0; ///< 0: done
    Bytes data;
  };
  struct WillSleep {}; ///< unless something is asked of it
  std::variant<Answer, vm::Sample, vm::event::Collision, vm::stimulus::Battery, WillSleep> what;
};

/// A request, but for its sequence number.
struct Request {
  std::uint8_t did = 0;
  std::uint8_t cid = 0;
  Bytes data;
  /// Whether a run can do without it, where the robot refuses it.
  enum class Need : std::uint8_t { Must, Try };
  Need need = Need::Must;
};

/// Whether a run begins with the robot's heading and place set to 0.
enum class Aim : std::uint8_t { Zero, Keep };

/// What counts as a collision: per axis a threshold and what full speed adds to it.
struct CollisionLimits {
  int threshold =
      32;         ///< 1..255. Source: LIB, the least of what clients use; 100 misses a wall at 40
  int speed = 32; ///< 0..255

  /// The operands of `configure-collision-detection`, of v1 and v2 alike.
  Bytes operands() const;
  static Bytes off() { return Bytes(6, 0); }
};

/// What a robot says of a collision: 16 or 18 bytes, the speed after two powers (API v1) or three
/// (v2); nothing for another size.
std::optional<vm::event::Collision> read_collision(ByteView data, std::size_t speed_at);

/// The packets of a robot: what is wanted of it as requests, what it sends as values. It holds no
/// time and sends nothing.
class RobotWire {
public:
  virtual ~RobotWire() = default;

  virtual Bytes encode(const Request& request, std::uint8_t seq) const = 0;
  virtual std::uint8_t next_seq(std::uint8_t seq) const = 0;
  /// Takes a copy: what is left when somebody stops asking next() is told later.
  virtual void feed(ByteView bytes) = 0;
  virtual std::optional<Said> next() = 0;

  /// What readies it for a run, in order. Answers go to hear_setup(); nothing for a refusal.
  virtual std::vector<Request> setup(Aim aim) const = 0;
  virtual void hear_setup(const Request& request, const std::optional<Bytes>& answer) = 0;
  /// What is sent once setup() has been answered and depends on the answers.
  virtual std::vector<Request> setup_more() const { return {}; }
  /// What lets it say what it feels, and what silences it.
  virtual std::vector<Request> stream(const Streamed& streamed) = 0;
  virtual std::vector<Request> silence() const = 0;
  /// What undoes setup(), after the robot has been stopped and silenced.
  virtual std::vector<Request> teardown() const = 0;

  /// Nothing for what it cannot do.
  virtual std::optional<Request> drive(const vm::Motion& motion) const = 0;
  virtual Request brake(int heading_deg) const = 0;
  virtual std::vector<Request> show(vm::Color color) const = 0;
  virtual std::optional<Request> show_back(int level) const = 0;

  /// So long after this request of setup() it drops what moves it.
  virtual Duration rests_after(const Request&) const { return {}; }
  /// What asks for the voltage of its battery, or, where it does not tell, keeps it awake. The
  /// answer is read by read_battery().
  virtual Request ask_battery() const = 0;
  virtual std::optional<vm::stimulus::Battery> read_battery(const Bytes& answer) const = 0;

  /// Whether it switches stabilization off: then the robot ignores a roll until that is on again.
  virtual bool loosens(const Request& request) const = 0;

  virtual Duration interval() const = 0;
  /// `drive-with-heading (16h 07h)`
  std::string name_of(const Request& request) const;
  /// `busy`, `bad length`, as the robot's tables say it.
  virtual std::string describe(std::uint8_t error) const = 0;
  virtual bool means_later(std::uint8_t error) const = 0;

private:
  /// As its row has it; empty where no row does.
  virtual std::string_view command_name(const Request& request) const = 0;
};

std::unique_ptr<RobotWire> make_wire(spec::Robot robot, CollisionLimits limits = {});

} // namespace orb::run
