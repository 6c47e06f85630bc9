#pragma once

#include "base/time.h"
#include "spec/basic.h"
#include "vm/body/body.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace orb::vm {

// Events of a ball, as values: the basis of `orb run --trace`, reports and drawings. Names and
// units are those of the trace (docs/using/ball.md).
namespace event {

/// A print statement passed its text to the print channel.
struct Print {
  std::string text;
};
/// A program stopped with an error of the robot.
struct Error {
  int line = 0;
  spec::BasicError code{};
};
/// The colour that shows changed.
struct Led {
  Color color;
};
struct BackLed {
  int value = 0;
};
/// The LED matrix shows this picture. If one colour fills it, Led is reported, too.
struct Matrix {
  std::array<Color, 64> pixels{}; ///< rows from the bottom left, as in vm::Matrix
};
/// A drive command was obeyed.
struct Drive {
  Roll roll;
};
/// The place of the ball, every 50 ms while it moves and when it comes to rest.
struct Position {
  Pose pose;
  std::optional<Duration> age = {}; ///< age of a remote robot's sample
};
struct Marker {
  int marker = 0;
  int macro = 0;
  int command = 0;
};
/// The macro executive began a command.
struct Macro {
  int id = 0;
  int command = 0;
};
/// A line of a program ended; only if the observer asked for lines.
struct Line {
  int line = 0;
};
/// A blow exceeded the client's thresholds.
struct Collision {
  int x = 0;
  int y = 0;
  int axis = 0;
  int x_magnitude = 0;
  int y_magnitude = 0;
  int speed = 0;
};
/// The ball hit a wall or another ball, or was hit by one. Reported even without collision
/// detection.
struct Bump {
  Wall wall;
  int speed = 0;         ///< 0..255 at the moment of the blow
  std::string ball = {}; ///< the name of the other ball; empty for a wall
};
/// A macro ended.
struct MacroEnd {
  enum class Reason : std::uint8_t {
    Ended,       ///< End, the last byte, or Stream End in a stream
    Aborted,     ///< by the client, by orbBasic, or because its buffer is rewritten
    NoSuchMacro, ///< goto, gosub or a collision led to a missing id
    BadCommand,  ///< an unknown command byte, or a command truncated by the macro's end
    StreamEnd,   ///< Stream End in a macro that is not a stream
    Inhibited,   ///< goto or a collision led to a macro that must not run while connected
    Slept        ///< a sleep command, or the ball fell asleep
  };
  int macro = 0;
  int command = 0; ///< the last command begun, from 1
  Reason reason = Reason::Ended;
};
struct Sleep {
  int seconds = 0;
  int macro = 0;
  int line = 0;
};
/// The program ended.
struct End {
  enum class Reason : std::uint8_t { End, Error, Abort, Sleep };
  Reason reason = Reason::End;
  std::uint64_t lines = 0;
};

/// A remote robot has not acknowledged a stop; it may still be driving.
struct StopLost {};

} // namespace event

using Event = std::variant<event::Print, event::Error, event::Led, event::BackLed, event::Drive,
                           event::Position, event::Marker, event::Macro, event::Line,
                           event::Collision, event::Sleep, event::End, event::MacroEnd, event::Bump,
                           event::StopLost, event::Matrix>;

/// Returns `ran into the wall x=70`, or `met ball blue`.
inline std::string words_of(const event::Bump& bump) {
  return bump.ball.empty() ? "ran into the wall " + to_string(bump.wall) : "met ball " + bump.ball;
}

/// Receives the events of a ball in order.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void on_event(Instant at, const Event& event) = 0;
};

} // namespace orb::vm
