#pragma once

#include "base/exit_code.h"
#include "base/style.h"
#include "base/time.h"
#include "report/course.h"
#include "report/journey.h"
#include "run/cause/cause.h"
#include "run/input.h"
#include "spec/firmware.h"
#include "spec/robots.h"
#include "vm/ball.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// A run: takes sources and options, reports prints and events, returns how it ended. Uploads to a
// ball in this process and simulates it in virtual time: equal inputs and options give equal runs.

namespace orb::run {

struct Profile;

/// Client connection while the program runs.
enum class Client : std::uint8_t { Connected, Absent };

/// How long a run continues after everything has finished.
enum class Until : std::uint8_t {
  Quiet, ///< not at all: it does not wait for motion
  Rest,  ///< until the ball rests, or the bound is reached
};

/// Reporting of body steps to the listener.
enum class Steps : std::uint8_t { Ignored, Heard };

/// Source of numbers for `input` after the given ones: none, or the listener.
enum class Asks : std::uint8_t { No, Yes };

/// `Others`: the ball is in a room. Its places are then those of the room, and a streamed macro
/// begins when the room does.
enum class Among : std::uint8_t { Nobody, Others };

/// The options of a run. Large because all kinds of runs share them: virtual or with a robot, alone
/// or in a room.
struct Options {
  Duration bound = 60s;              ///< in robot time; zero: none
  std::optional<std::uint16_t> line; ///< start line; default: the first
  std::uint64_t seed = 1;
  std::vector<std::int32_t> numbers; ///< for `input`, in order
  Asks asks = Asks::No;              ///< once `numbers` is used up
  Client client = Client::Connected;
  compiler::Target target; ///< its area is where the program is stored
  spec::Firmware firmware = spec::default_firmware;
  spec::Robot model = spec::Robot::Sphero;        ///< determines the driving parameters
  std::optional<spec::Driving> driving;           ///< default: those of `model`
  std::optional<std::size_t> ram_bytes;           ///< default: those of the firmware
  spec::Ranges ranges = spec::Ranges::Documented; ///< Lenient is also implied by some firmware
  std::uint32_t lines_per_second =
      static_cast<std::uint32_t>(spec::value_of(spec::Limit::LinesPerSecond));
  vm::Native native = vm::Native::Auto;          ///< when programs are compiled to machine code
  vm::NativePrograms* native_programs = nullptr; ///< machine code shared by runs; may be null
  bool trace_lines = false;                      ///< report every line to the listener
  Steps steps = Steps::Ignored;
  Until until = Until::Quiet;
  Duration slice = 1s; ///< interval of on_time() calls
  std::vector<vm::TimedStimulus> stimuli;
  vm::Placement start; ///< starting place in a room
  Among among = Among::Nobody;
  const report::Course* course = nullptr; ///< the course to drive; must outlive the run
  vm::RemoteBody* robot = nullptr;        ///< remote robot used as the body; must outlive the run
  vm::Sample robot_sample;                ///< its sample before the start
  std::string expect;                     ///< text that ends the run as a success; empty: none
  std::string fail_text;                  ///< text that ends the run as a failure; empty: none

  /// Gives the virtual ball the driving parameters of a profile.
  void drive_like(const Profile& profile);
};

/// A run-time error and its place in the user's file.
struct ProgramError {
  std::uint32_t robot_line = 0;
  bool numbered = true; ///< the source has line numbers
  spec::BasicError code{};
  std::string file;
  Position place{0, 0}; ///< line 0: the file has no such line
  Cause cause;
  Message finding; ///< the linter's finding for that line; may be empty
  Message help;    ///< what to write; may be empty
};

/// Explains a fault from the source and, if not null, from the machine that stopped there.
ProgramError explain(const Input& input, int robot_line, spec::BasicError code,
                     const vm::Machine* machine);

/// Returns what to write instead: for the offending value, otherwise for the linter's finding; may
/// be empty.
const Message& help_of(const ProgramError& fault);

/// Returns the error for people: a line that begins with its place, details below.
std::string render(const ProgramError& fault, Style style);

struct Ending;

/// Follows a run. Times count from its start.
class Listener {
public:
  virtual ~Listener() = default;
  /// The run begins. The ball exists until after on_end().
  virtual void on_start(const vm::Ball&) {}
  virtual void on_event(Duration t, const vm::Event& event) = 0;
  /// The program stopped with an error; on_event() is not called for it.
  virtual void on_fault(Duration t, const ProgramError& fault) = 0;
  /// The body has taken a step; only with Steps::Heard.
  virtual void on_step(Duration, const vm::Body&) {}
  /// The run has reached `t`. With --realtime, the moment to wait.
  virtual void on_time(Duration) {}
  /// The run is over; the ball is in its final state.
  virtual void on_end(const Ending&) {}
  /// Called after each event and step: true ends the run here.
  virtual bool enough() const { return false; }
  /// `input` waits and no number is left. nullopt: none will come.
  virtual std::optional<std::int32_t> ask_number() { return std::nullopt; }
  /// Returns true if ask_number() may return a number later.
  virtual bool has_more_numbers() const { return false; }
};

/// Why a run ended. to_string() gives the words of the trace.
enum class Reason : std::uint8_t { End, Error, Abort, TimeLimit, Sleep, Input };
std::string_view to_string(Reason reason);

/// The sought text that was found in the output.
enum class Sought : std::uint8_t { Nothing, Expected, Forbidden };

/// What an observer saw of the ball.
struct Sight {
  enum class Motion : std::uint8_t { Still, Rolling, Driven };
  Motion motion = Motion::Still; ///< at the end; Driven: its target speed is set
  vm::Pose pose;                 ///< at the end
  std::uint64_t way_cm = 0;
  bool told_to_move = false;
  bool turned = false;
  std::optional<vm::Color> color; ///< of the LED, if it changed
  std::vector<vm::Wall> walls;    ///< walls it hit, each once
  std::uint64_t bumps = 0;        ///< number of hits on walls
  std::set<std::string> met;      ///< names of the balls it met
};

struct Ending {
  Reason reason = Reason::End;
  Duration lasted{};  ///< until nothing ran any more
  Duration seen_to{}; ///< end of observation: later than `lasted` with Until::Rest
  std::uint64_t lines = 0;
  std::uint64_t commands = 0; ///< of macros
  std::vector<ProgramError> faults;
  std::string aborted; ///< why a macro aborted by itself; empty if none did
  Sought seen = Sought::Nothing;
  Sight sight;
  std::string waits_for;             ///< `a number at line 20`; empty if it waits for nothing
  std::optional<bool> robot_stopped; ///< the remote robot has acknowledged the final stop
  std::string_view only_interpreted; ///< why there was no machine code although it was requested
  std::vector<vm::NativeCode::Piece> machine_code; ///< its addresses, for profilers
};

/// Returns for example `ended` or `stopped by the time limit`.
std::string_view manner(Reason reason);

/// Returns the figures of an ending: `ended after 1.234 s of robot time, 3702 lines`; for a macro
/// its commands.
std::string to_string(const Ending& ending);

/// Returns what happened to the ball: `stopped at 7,3 cm after 1.9 m, green, hit 1 wall, waits for
/// a shake`; empty if the program only computed and printed.
std::string story(const Ending& ending);

/// Runs the first program, or the first macro if there is no program; the others are only loaded. A
/// second program goes into the other area. `journey` may be null. Fails if the ball rejects an
/// upload; errors of the program itself are part of the ending.
tl::expected<Ending, Failure> run(std::span<const Input> inputs, const Options& options,
                                  Listener& listener, report::Journey* journey);

} // namespace orb::run
