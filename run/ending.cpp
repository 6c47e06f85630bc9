#include "base/text/text.h"
#include "base/text/utf8.h"
#include "run/run.h"
#include "spec/colours.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace orb::run {
namespace {

/// Returns the nearest colour name of LEDC, ignoring brightness.
std::string name_of(vm::Color color) {
  constexpr int brightest = 255;
  constexpr int dim_below = 64;
  const int most = std::max({color.red, color.green, color.blue});
  if (most == 0)
    return "LED off";
  const auto far = [&](const spec::LedColour& row) {
    const auto square = [&](int part, int of_row) {
      const int difference = part * brightest / most - of_row;
      return difference * difference;
    };
    return square(color.red, row.red) + square(color.green, row.green) +
           square(color.blue, row.blue);
  };
  const auto nearest =
      std::min_element(spec::led_colours.begin(), spec::led_colours.end(),
                       [&](const auto& a, const auto& b) { return far(a) < far(b); });
  return fmt::format("{}{}", most < dim_below ? "dim " : "", nearest->name);
}

std::string length(std::uint64_t cm) {
  return cm < 100 ? fmt::format("{} cm", cm)
                  : fmt::format("{:.1f} m", static_cast<double>(cm) / 100);
}

/// Describes where the ball went; empty if nothing moved it or tried to.
std::string way(const Sight& sight) {
  if (sight.way_cm == 0) {
    if (sight.motion == Sight::Motion::Driven)
      return "only just starting to move";
    return sight.turned ? "turned on the spot" : sight.told_to_move ? "did not move" : "";
  }
  const auto verb = [&] {
    switch (sight.motion) {
    case Sight::Motion::Still: return "stopped";
    case Sight::Motion::Rolling: return "still rolling";
    case Sight::Motion::Driven: return "still driving";
    }
    return "";
  };
  return fmt::format("{} at {},{} cm after {}", verb(), std::lround(sight.pose.x_cm),
                     std::lround(sight.pose.y_cm), length(sight.way_cm));
}

std::string blows(const Sight& sight) {
  if (sight.bumps == 0)
    return "";
  const auto walls = fmt::format("hit {}", plural(sight.walls.size(), "wall"));
  return sight.bumps == sight.walls.size() ? walls : fmt::format("{} {} times", walls, sight.bumps);
}

} // namespace

std::string_view to_string(Reason reason) {
  switch (reason) {
  case Reason::End: return "end";
  case Reason::Error: return "error";
  case Reason::Abort: return "abort";
  case Reason::TimeLimit: return "time-limit";
  case Reason::Sleep: return "sleep";
  case Reason::Input: return "input";
  }
  return "";
}

std::string_view manner(Reason reason) {
  switch (reason) {
  case Reason::End:
  case Reason::Error: return "ended";
  case Reason::Abort: return "stopped";
  case Reason::TimeLimit: return "stopped by the time limit";
  case Reason::Sleep: return "fell asleep, ended";
  case Reason::Input: return "still waiting for input, ended";
  }
  return "";
}

std::string to_string(const Ending& ending) {
  const auto ms = ending.lasted / 1ms;
  const bool only_macros = ending.lines == 0 && ending.commands > 0;
  return fmt::format(
      "{} after {}.{:03} s of robot time, {}", manner(ending.reason), ms / 1000, ms % 1000,
      only_macros ? plural(ending.commands, "command") : plural(ending.lines, "line"));
}

std::string story(const Ending& ending) {
  const auto& sight = ending.sight;
  std::string told;
  const auto tell = [&](const std::string& clause) {
    if (!clause.empty())
      (told += told.empty() ? "" : ", ") += clause;
  };
  tell(way(sight));
  tell(sight.color ? name_of(*sight.color) : "");
  tell(blows(sight));
  tell(sight.met.empty() ? "" : fmt::format("met {}", fmt::join(sight.met, " and ")));
  tell(ending.waits_for.empty() ? "" : "waiting for " + ending.waits_for);
  return told;
}

const Message& help_of(const ProgramError& fault) {
  return fault.cause.help.empty() ? fault.help : fault.cause.help;
}

std::string render(const ProgramError& fault, Style style) {
  const auto place = fault.place.line == 0
                         ? std::string()
                         : fmt::format(":{}:{}", fault.place.line, fault.place.column);
  const auto& cause = fault.cause;
  const auto line = fault.numbered ? fmt::format("line {}: ", fault.robot_line) : std::string();
  auto text = fmt::format("{}{}: {}: {}{}{}{}\n", shown_name(fault.file), place,
                          style.paint(Role::Error, "error"), line, spec::info(fault.code).text,
                          cause.seen.empty() ? "" : ": ", cause.seen);
  if (const auto details = cause.seen.empty() ? in_english(fault.finding) : cause.variables;
      !details.empty())
    text += fmt::format("  {}\n", details);
  if (!cause.aside.empty())
    text += fmt::format("  note: {}\n", cause.aside);
  if (const auto& help = help_of(fault); !help.empty())
    text += fmt::format("  help: {}\n", in_english(help));
  return text;
}

} // namespace orb::run
