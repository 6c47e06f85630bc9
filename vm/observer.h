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

// What happens to a ball, as values: `orb run --trace`, reports and drawings are made from these.
// The names and units are those of the trace (docs/ball.md).
namespace event {

/// A print statement handed its text to the print channel.
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
/// The matrix of lamps shows this picture; of a colour that fills it Led tells.
struct Matrix {
  std::array<Color, 64> pixels{}; ///< row by row from the bottom left, as vm::Matrix has them
};
/// A drive command was obeyed.
struct Drive {
  Roll roll;
};
/// Where the ball is; every 50 ms while it moves, and where it comes to rest.
struct Position {
  Pose pose;
  std::optional<Duration> age = {}; ///< since a robot that is elsewhere has said so
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
/// A line of a program ended; only when the observer asks for lines.
struct Line {
  int line = 0;
};
/// A blow exceeded the thresholds that a client set.
struct Collision {
  int x = 0;
  int y = 0;
  int axis = 0;
  int x_magnitude = 0;
  int y_magnitude = 0;
  int speed = 0;
};
/// The ball ran into a wall or another ball, or that into it, whether or not anybody asked it to
/// detect collisions.
struct Bump {
  Wall wall;
  int speed = 0;         ///< 0..255 at the moment of the blow
  std::string ball = {}; ///< the name of the other ball; empty where it was the wall
};
/// A macro came to its end, by itself or not.
struct MacroEnd {
  enum class Reason : std::uint8_t {
    Ended,       ///< End, the last byte, or Stream End in a stream
    Aborted,     ///< by the client, by orbBasic, or because its buffer is being rewritten
    NoSuchMacro, ///< goto, gosub or a collision led to an id that is not there
    BadCommand,  ///< a byte that is not a command, or a command that runs past the macro
    StreamEnd,   ///< Stream End in a macro that is not a stream
    Inhibited,   ///< goto or a collision led to a macro that does not run while connected
    Slept        ///< a sleep command, or the ball fell asleep
  };
  int macro = 0;
  int command = 0; ///< the last that was begun, from 1
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

/// A robot that is elsewhere has not acknowledged that it stops; it may still drive.
struct StopLost {};

} // namespace event

using Event = std::variant<event::Print, event::Error, event::Led, event::BackLed, event::Drive,
                           event::Position, event::Marker, event::Macro, event::Line,
                           event::Collision, event::Sleep, event::End, event::MacroEnd, event::Bump,
                           event::StopLost, event::Matrix>;

/// `ran into the wall x=70`, `met ball blue`.
inline std::string words_of(const event::Bump& bump) {
  return bump.ball.empty() ? "ran into the wall " + to_string(bump.wall) : "met ball " + bump.ball;
}

/// Sees what happens to a ball, in the order in which it happens.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void on_event(Instant at, const Event& event) = 0;
};

} // namespace orb::vm
