#pragma once

#include "base/diagnostic.h"
#include "base/slots.h"
#include "base/source.h"
#include "base/time.h"
#include "spec/ball.h"
#include "vm/body/body.h"
#include "vm/texts.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace orb::vm {

/// Events that the world or a client inflicts on a ball. docs/using/ball.md lists the lines of a
/// script.
namespace stimulus {

struct Shake {};
struct Toss {
  Duration time;
};
struct Push {
  int heading_deg = 0;
  int strength = 0; ///< 0..255
};
/// A roll command from a client.
struct ClientRoll {
  Roll roll;
};
/// A colour from a client.
struct ClientColor {
  Color color;
};
struct Connect {};
struct Disconnect {};
struct Battery {
  double volts = 0;
};
struct Charger {
  Switch state = Switch::Off;
};
/// A number for `input`.
struct Number {
  std::int32_t value = 0;
};
struct Tilt {
  double pitch_deg = 0;
  double roll_deg = 0;
};
struct Spin {
  double deg_per_s = 0;
};
struct Noise {
  Switch state = Switch::Off;
};

} // namespace stimulus

using Stimulus = std::variant<Wall, stimulus::Shake, stimulus::Toss, stimulus::Push,
                              stimulus::ClientRoll, stimulus::ClientColor, stimulus::Connect,
                              stimulus::Disconnect, stimulus::Battery, stimulus::Charger,
                              stimulus::Number, stimulus::Tilt, stimulus::Spin, stimulus::Noise>;

struct TimedStimulus {
  Duration at{};
  Stimulus stimulus;
};

/// The words of a script.
enum class StimulusWord : std::uint8_t {
#define ORB_STIMULUS(name, ...) name,
#include "vm/stimulus.def"
#undef ORB_STIMULUS
};

/// Describes a word of a stimulus script.
struct StimulusInfo {
  std::string_view word;
  Slots slots;
  std::string_view summary;
  std::string_view example; ///< a whole line
};

/// The values that follow those words.
namespace slot {
using namespace orb::slot;

inline constexpr Slot heading = whole("HEADING", texts::Heading, 0, spec::ball::full_circle - 1);
inline constexpr Slot on_off = choice("on|off", texts::State);
constexpr int farthest_wall = 1'000'000; // cm; arithmetic on it stays exact
inline constexpr Slot wall{.kind = Kind::Axis,
                           .shown = "x=CM|y=CM",
                           .least = -farthest_wall,
                           .most = farthest_wall,
                           .usual = "x=70",
                           .words = "="};

constexpr Slot byte(std::string_view shown, const Row<>& called) {
  return whole(shown, called, 0, spec::ball::greatest);
}
/// In degrees or degrees a second, positive or negative.
constexpr Slot angle(std::string_view shown, const Row<>& called, double most) {
  return number(shown, called, -static_cast<int>(most), static_cast<int>(most));
}
} // namespace slot

/// All words, in the order of vm/stimulus.def.
inline constexpr auto stimulus_words = std::to_array<StimulusInfo>({
#define ORB_STIMULUS(name, word, slots, summary, example) {word, slots, summary, example},
#include "vm/stimulus.def"
#undef ORB_STIMULUS
});

/// A parsed script and its diagnostics. Lines that cannot be read are left out.
struct StimulusScript {
  std::vector<TimedStimulus> events; ///< by time; equal times as written
  std::vector<Diagnostic> diagnostics;
};

StimulusScript parse_stimulus(const Source& source);

/// What a line asks of a running ball: `shake` and `at now shake` happen at once, `at 2s shake` at
/// that time of the ball.
struct LiveStimulus {
  StimulusScript script;
  bool at_once = true;
};
LiveStimulus read_live_stimulus(std::string_view line);

/// Returns true if the text is itself a line of a script, such as `at 2s shake`, and not the name
/// of a file.
bool is_stimulus_line(std::string_view text);

/// Sorts by time; equal times keep their order.
void sort_by_time(std::vector<TimedStimulus>& events);

/// Parses one line (from 1) of a text that may contain other lines, and adds it to `script`.
void read_stimulus_line(const Source& source, std::uint32_t line, StimulusScript& script);

} // namespace orb::vm
