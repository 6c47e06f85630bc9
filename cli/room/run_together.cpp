#include "cli/room/run_together.h"

#include "base/refuse.h"
#include "cli/input/inputs.h"
#include "cli/input/target.h"
#include "cli/room/room_console.h"
#include "cli/room/room_plan.h"
#include "cli/run/run_options.h"
#include "disk/disk.h"
#include "report/page.h"
#include "report/reload.h"
#include "report/svg.h"
#include "run/room.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace orb::cli {
namespace {

/// Rejects options that a room does not support.
tl::expected<void, Failure> check_options(const RunOptions& given) {
  struct Given {
    bool is = false;
    std::string_view option;
    std::string_view instead;
  };
  const auto refused = std::to_array<Given>({
      {!given.port.port.empty(), "--port", "a robot cannot join a room"},
      {!given.replay.empty(), "--replay", "a robot cannot join a room"},
      {given.run.line.has_value(), "--line", "each program begins at its first line"},
      {!given.input.empty(), "--input",
       "give a ball its numbers with `stimulus = \"at 2s input 42\"` in a room file"},
      {!given.compare.empty(), "--compare", "compare the balls one by one"},
  });
  for (const auto& one : refused)
    if (one.is)
      return refuse(ExitCode::Usage,
                    fmt::format("`{}` is for one ball; {}", one.option, one.instead));
  return {};
}

/// A room with everything its balls refer to.
struct Furnished {
  RoomPlan plan;
  std::optional<report::Course> course;
  std::deque<std::vector<run::Input>> inputs;
  std::deque<report::Journey> journeys;
  std::vector<run::RoomBall> balls;
};

tl::expected<RoomPlan, Failure> plan_of(const RunOptions& given) {
  if (!is_room_file(given.files.front()))
    return side_by_side(given.files);
  if (given.files.size() > 1)
    return refuse(ExitCode::Usage,
                  fmt::format("{} is a room, which names its own programs; omit {}",
                              disk::display_name(given.files[0]),
                              disk::display_name(given.files[1])));
  auto plan = read_room(given.files.front());
  if (plan && !given.course.empty())
    plan->course = given.course;
  return plan;
}

/// The options of one ball: the common ones plus its own.
tl::expected<run::Options, Failure> options_of(const Context& context, const run::Options& all,
                                               const PlannedBall& ball) {
  auto options = all;
  options.start = ball.start;
  options.seed = ball.seed.value_or(run::seed_of(all.seed, ball.name));
  if (!ball.robot.empty()) { // overrides the common `--robot` and `--ball`
    options.model = spec::find_robot(ball.robot)->robot;
    options.driving.reset();
  }
  auto own = read_stimuli(context, ball.stimuli);
  if (!own)
    return tl::unexpected(own.error());
  options.stimuli.insert(options.stimuli.end(), own->begin(), own->end());
  vm::sort_by_time(options.stimuli);
  return options;
}

tl::expected<void, Failure> furnish(const Context& context, const RunOptions& given,
                                    const run::Options& all, Furnished& room) {
  for (const auto& ball : room.plan.balls) {
    auto inputs = read_inputs(ball.files, given.language, all.target);
    if (!inputs)
      return refuse(inputs.error().code,
                    ball.place.empty() ? inputs.error().message
                                       : fmt::format("{}: {}", ball.place, inputs.error().message));
    for (const auto& input : *inputs)
      if (input.has_errors()) {
        print_findings(context, input.errors);
        return refuse(ExitCode::BadInput, fmt::format("{} has errors", input.source->name()));
      }
    auto options = options_of(context, all, ball);
    if (!options)
      return tl::unexpected(options.error());
    room.inputs.push_back(*std::move(inputs));
    room.balls.push_back({ball.name, room.inputs.back(), *std::move(options), nullptr, nullptr});
  }
  return {};
}

/// Reports the first ball that starts in an impossible place.
tl::expected<void, Failure> check_places(const Furnished& room) {
  const auto found = run::clashes(room.balls);
  if (found.empty())
    return {};
  const auto& clash = found.front();
  const auto& ball = room.plan.balls[clash.ball];
  const auto what =
      clash.other ? fmt::format("starts inside ball `{}`", room.balls[*clash.other].name)
                  : fmt::format("starts too close to the wall {}", vm::to_string(*clash.wall));
  constexpr double digits = 10; // tenths of a centimetre
  return refuse(ExitCode::Usage,
                fmt::format("{}{}ball `{}` {}: {:g} cm from it; at least {:g} cm is needed",
                            ball.place, ball.place.empty() ? "" : ": ", ball.name, what,
                            std::floor(clash.apart_cm * digits) / digits,
                            clash.other ? 2 * spec::ball::radius : spec::ball::radius));
}

void tell(const Context& context, const run::RoomBall& ball, const run::Ending& ending) {
  for (const auto& fault : ending.faults)
    print_err(fmt::format("{}: {}", ball.name, run::render(fault, context.err_style())));
  const auto story = run::story(ending);
  print_note(context, fmt::format("{}: {}{}{}", ball.name, story, story.empty() ? "" : "; ",
                                  run::to_string(ending)));
}

/// The balls by name, for a picture.
std::vector<report::RoomRun> runs_of(const Furnished& room) {
  std::vector<report::RoomRun> runs;
  for (const auto& ball : room.balls)
    runs.push_back({ball.name, ball.journey});
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return runs;
}

tl::expected<void, IoError> write_room_pictures(const RunOptions& given, const Furnished& room) {
  const auto runs = runs_of(room);
  const auto title = is_room_file(given.files.front()) ? disk::display_name(given.files.front())
                                                       : std::string("room");
  if (!given.report.empty()) {
    auto page = report::room_page(runs, title, structured::keyword_words);
    if (given.watch)
      page = report::reloading(std::move(page));
    if (auto done = disk::write(given.report, as_bytes(page)); !done)
      return done;
  }
  return given.svg.empty() ? tl::expected<void, IoError>()
                           : disk::write(given.svg, as_bytes(report::room_svg(runs)));
}

/// Judges the room by the balls' output, if the user asked for that.
tl::expected<void, Failure> judge_room(const RunOptions& given, const Furnished& room,
                                       const std::vector<run::Ending>& endings) {
  bool expected = false;
  for (std::size_t i = 0; i < endings.size(); ++i) {
    expected = expected || endings[i].seen == run::Sought::Expected;
    if (endings[i].seen == run::Sought::Forbidden)
      return refuse(ExitCode::BadInput,
                    fmt::format("ball `{}` printed `{}`", room.balls[i].name, given.run.fail_text));
  }
  if (!given.run.expect.empty() && !expected)
    return refuse(ExitCode::BadInput, fmt::format("no ball printed `{}`", given.run.expect));
  for (std::size_t i = 0; i < endings.size(); ++i)
    if (!endings[i].aborted.empty())
      return refuse(ExitCode::BadInput,
                    fmt::format("{}: {}", room.balls[i].name, endings[i].aborted));
  return {};
}

/// Reads everything; reports errors before anything runs.
tl::expected<void, Failure> prepare(const Context& context, const RunOptions& given,
                                    Furnished& room) {
  if (auto fits = check_options(given); !fits)
    return fits;
  const auto all = read_options(context, given);
  if (!all)
    return tl::unexpected(all.error());
  auto plan = plan_of(given);
  if (!plan)
    return tl::unexpected(plan.error());
  room.plan = *std::move(plan);
  if (auto done = furnish(context, given, *all, room); !done)
    return done;
  const auto& path = room.plan.course.empty() ? given.course : room.plan.course;
  if (!path.empty()) {
    auto course = read_course(context, path);
    if (!course)
      return tl::unexpected(course.error());
    room.course = *std::move(course);
    for (auto& ball : room.balls)
      ball.options.course = &*room.course;
  }
  return check_places(room);
}

} // namespace

bool is_room(const RunOptions& given) {
  return is_room_file(given.files.front()) || (given.together && given.files.size() > 1);
}

tl::expected<void, Failure> run_together(Context& context, const RunOptions& given) {
  Furnished room;
  if (auto ready = prepare(context, given, room); !ready)
    return ready;
  vm::NativePrograms native;
  const bool pictures = !given.report.empty() || !given.svg.empty();
  std::vector<const run::RoomBall*> balls;
  for (auto& ball : room.balls) {
    ball.options.native_programs = &native;
    if (pictures)
      ball.journey = &room.journeys.emplace_back();
    balls.push_back(&ball);
  }
  RoomConsole console(given, balls);
  for (std::size_t i = 0; i < room.balls.size(); ++i)
    room.balls[i].listener = &console.ear(i);
  const auto endings = run::run_room(room.balls);
  if (!endings)
    return tl::unexpected(endings.error());
  auto written = console.finish(*endings);
  if (written && pictures)
    written = write_room_pictures(given, room);
  for (std::size_t i = 0; i < room.balls.size(); ++i)
    tell(context, room.balls[i], (*endings)[i]);
  if (!written)
    print_error(context, written.error().message);
  if (auto good = judge_room(given, room, *endings); !good)
    return good;
  const bool faults = std::any_of(endings->begin(), endings->end(),
                                  [](const auto& ending) { return !ending.faults.empty(); });
  if (faults)
    context.exit = ExitCode::BadInput;
  else if (!written)
    context.exit = ExitCode::File;
  return {};
}

tl::expected<std::vector<std::string>, Failure> open_rooms(const std::vector<std::string>& files) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& file) {
    if (std::find(all.begin(), all.end(), file) == all.end())
      all.push_back(file);
  };
  for (const auto& file : files) {
    if (!is_room_file(file)) {
      all.push_back(file);
      continue;
    }
    const auto plan = read_room(file);
    if (!plan)
      return tl::unexpected(plan.error());
    for (const auto& ball : plan->balls)
      std::for_each(ball.files.begin(), ball.files.end(), add);
    if (!plan->course.empty())
      add(plan->course);
  }
  return all;
}

tl::expected<void, Failure> check_room(const Context& context, const std::string& file) {
  RunOptions given;
  given.files = {file};
  given.port.port.clear();
  Furnished room;
  const OutputTap silence([](auto, auto) {}); // findings about its files have been printed
  return prepare(context, given, room);
}

} // namespace orb::cli
