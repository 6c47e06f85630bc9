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

// A run: sources and options in; prints and events while it goes on; how it ended out. It uploads
// to a ball in this process and lets it live in virtual time: the same inputs and options give the
// same run.

namespace orb::run {

struct Profile;

/// Whether a client is connected while the program runs.
enum class Client : std::uint8_t { Connected, Absent };

/// What a run goes on for after nothing runs any more.
enum class Until : std::uint8_t {
  Quiet, ///< nothing: motion is not awaited
  Rest,  ///< until the ball rests, or the bound is reached
};

/// Whether the listener hears of every step of the body.
enum class Steps : std::uint8_t { Ignored, Heard };

/// Whether the listener has numbers for `input`.
enum class Asks : std::uint8_t { No, Yes };

/// Whether the ball is one of a room: then its places are those of the room, and a streamed macro
/// begins when the room does.
enum class Among : std::uint8_t { Nobody, Others };

struct Options {
  Duration bound = 60s;              ///< of robot time; zero: none
  std::optional<std::uint16_t> line; ///< where the program starts; else at its first line
  std::uint64_t seed = 1;
  std::vector<std::int32_t> numbers; ///< for `input`, in order
  Asks asks = Asks::No;              ///< where these are used up
  Client client = Client::Connected;
  compiler::Target target; ///< its area is where the program lies
  spec::Firmware firmware = spec::default_firmware;
  spec::Robot model = spec::Robot::Sphero;        ///< whose way of driving it has
  std::optional<spec::Driving> driving;           ///< else that of `model`
  std::optional<std::size_t> ram_bytes;           ///< else what the firmware has
  spec::Ranges ranges = spec::Ranges::Documented; ///< Lenient also where the firmware is
  std::uint32_t lines_per_second =
      static_cast<std::uint32_t>(spec::value_of(spec::Limit::LinesPerSecond));
  vm::Native native = vm::Native::Auto;          ///< when programs become machine code
  vm::NativePrograms* native_programs = nullptr; ///< machine code that runs share; may be null
  bool trace_lines = false;                      ///< the listener hears every line
  Steps steps = Steps::Ignored;
  Until until = Until::Quiet;
  Duration slice = 1s; ///< how often the listener hears of the time
  std::vector<vm::TimedStimulus> stimuli;
  vm::Placement start; ///< where it stands, in a room
  Among among = Among::Nobody;
  const report::Course* course = nullptr; ///< what it drives through; must outlive the run
  vm::Elsewhere* robot = nullptr; ///< what it drives instead of a body; must outlive the run
  vm::Sample robot_sample;        ///< what that said of itself before the start
  std::string expect;             ///< printed: the run stops well; empty for none
  std::string fail_text;          ///< printed: the run stops as a failure; empty for none

  /// The virtual ball drives like the robot of that profile.
  void drive_like(const Profile& profile);
};

/// A fault of the robot and where it is in the user's file.
struct ProgramError {
  std::uint32_t robot_line = 0;
  bool numbered = true; ///< the source has such numbers
  spec::BasicError code{};
  std::string file;
  Position place{0, 0}; ///< line 0: the file has no such line
  Cause cause;
  Message finding; ///< what the linter says of that line; may be empty
  Message help;    ///< and what to write; may be empty
};

/// What is known of a fault in a program from its source, and from the machine that stopped there
/// where that is not null.
ProgramError explain(const Input& input, int robot_line, spec::BasicError code,
                     const vm::Machine* machine);

/// What to write instead: of the value that was wrong, else of what the linter says; may be empty.
const Message& help_of(const ProgramError& fault);

/// The error as people read it: a line that begins with its place, and details below.
std::string render(const ProgramError& fault, Style style);

struct Ending;

/// Hears a run while it goes on. Times count from its start.
class Listener {
public:
  virtual ~Listener() = default;
  /// The run begins. The ball is there until after on_end().
  virtual void on_start(const vm::Ball&) {}
  virtual void on_event(Duration t, const vm::Event& event) = 0;
  /// The program stopped with an error; on_event() does not hear of it.
  virtual void on_fault(Duration t, const ProgramError& fault) = 0;
  /// The body has taken a step; only with Steps::Heard.
  virtual void on_step(Duration, const vm::Body&) {}
  /// The run has reached `t`, which for --realtime is the moment to wait.
  virtual void on_time(Duration) {}
  /// The run is over; the ball is as the run left it.
  virtual void on_end(const Ending&) {}
  /// Asked after each event and step: whether the run may end here.
  virtual bool enough() const { return false; }
  /// `input` waits and no number is left; nothing when there will be none.
  virtual std::optional<std::int32_t> ask_number() { return std::nullopt; }
  /// Whether ask_number() may have one later though it has none now.
  virtual bool has_more_numbers() const { return false; }
};

/// Why a run is over. The words of the trace: to_string().
enum class Reason : std::uint8_t { End, Error, Abort, TimeLimit, Sleep, Input };
std::string_view to_string(Reason reason);

/// What was looked for in the output.
enum class Sought : std::uint8_t { Nothing, Expected, Forbidden };

/// What somebody who watched the ball has seen of it.
struct Sight {
  enum class Motion : std::uint8_t { Still, Rolling, Driven };
  Motion motion = Motion::Still; ///< at the end; driven: its speed is set
  vm::Pose pose;                 ///< at the end
  std::uint64_t way_cm = 0;
  bool told_to_move = false;
  bool turned = false;
  std::optional<vm::Color> color; ///< of the LED, where it changed
  std::vector<vm::Wall> walls;    ///< that it ran into, each once
  std::uint64_t bumps = 0;        ///< how often
  std::set<std::string> met;      ///< the names of the balls that it met
};

struct Ending {
  Reason reason = Reason::End;
  Duration lasted{};  ///< until nothing ran any more
  Duration seen_to{}; ///< the same, or longer with Until::Rest
  std::uint64_t lines = 0;
  std::uint64_t commands = 0; ///< of macros
  std::vector<ProgramError> faults;
  std::string aborted; ///< how a macro aborted by itself; empty where none did
  Sought seen = Sought::Nothing;
  Sight sight;
  std::string waits_for;             ///< `a number at line 20`; empty where it waits for nothing
  std::optional<bool> robot_stopped; ///< the robot elsewhere has acknowledged the stop at the end
  std::string_view only_interpreted; ///< why there was no machine code though it was wanted
  std::vector<vm::NativeCode::Piece> machine_code; ///< where it was, for profilers
};

/// How it ended: `ended`, `stopped by the time limit`.
std::string_view manner(Reason reason);

/// The figures of an ending: `ended after 1.234 s of robot time, 3702 lines`; of a macro its
/// commands.
std::string to_string(const Ending& ending);

/// What became of the ball: `stopped at 7,3 cm after 1.9 m, green, hit 1 wall, waits for a shake`;
/// empty where a program only computes and prints.
std::string story(const Ending& ending);

/// Runs the first program, or where there is none the first macro; the others are loaded beside it.
/// A second program lies in the other area. `journey` may be null. Fails where the ball does not
/// take what it is given; what the program itself does wrong is part of the ending.
tl::expected<Ending, Failure> run(std::span<const Input> inputs, const Options& options,
                                  Listener& listener, report::Journey* journey);

} // namespace orb::run
