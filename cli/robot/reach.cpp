#include "cli/robot/reach.h"

#include "cli/model/command.h"
#include "cli/terminal/interrupt.h"
#include "run/tether/find_robot.h"
#include "run/tether/hail.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace orb::cli {
namespace {

bool is_newer(spec::Robot robot) {
  return spec::info(robot).packets == spec::Packets::V2;
}

/// `BB-9E, R2-D2 or R2-Q5`
std::string titles(const std::vector<spec::Robot>& robots) {
  std::string text;
  for (std::size_t i = 0; i < robots.size(); ++i)
    text += fmt::format("{}{}",
                        i == 0                   ? ""
                        : i + 1 == robots.size() ? " or "
                                                 : ", ",
                        spec::info(robots[i]).title);
  return text;
}

/// True if all of them use the same kind of packets.
bool alike(const std::vector<spec::Robot>& robots) {
  const auto& first = spec::info(robots.front());
  return std::all_of(robots.begin(), robots.end(), [&](spec::Robot robot) {
    const auto& row = spec::info(robot);
    return row.targets == first.targets && row.sensors == first.sensors && row.lamps == first.lamps;
  });
}

/// The robots that the other end can be; none if nothing answers.
std::vector<spec::Robot> who_is_there(Link& link) {
  constexpr Duration patience = 2s;
  if (link.named)
    return {*link.named};
  if (link.packets != spec::Packets::V2) {
    const auto packets = run::find_packets(*link.transport, patience);
    if (!packets)
      return {};
    if (*packets == spec::Packets::V1)
      return {spec::Robot::Sphero};
  }
  return run::fitting_robots(*link.transport).value_or(std::vector<spec::Robot>());
}

ExitCode work_with_newer(Context& context, Link& link, const Newer& robot, std::string_view given,
                         const Talks& talks) {
  run::TalkV2 talk(*link.transport, robot.robot);
  if (const auto done = talks.newer(link, talk, robot); !done)
    fail(context, name_robot(link, given, done.error()));
  return context.exit;
}

ExitCode work_with(Context& context, Link& link, std::string_view given, const Talks& talks) {
  const auto told = told_robot(link, given);
  if (told && is_newer(*told))
    return work_with_newer(context, link, newer_of(*told), given, talks);
  run::Hail hail(*link.transport);
  if (link.packets != spec::Packets::V2) {
    auto& transport = link.packets ? *link.transport : hail;
    uploader::Session session(transport, link.budgets, link.first_seq);
    const auto greeting = uploader::greet(session);
    if (greeting)
      return talks.classic(link, session, *greeting);
    if (hail.answered() != spec::Packets::V2) {
      fail(context,
           name_robot(link, given, {exit_code(greeting.error().kind), greeting.error().message}));
      return context.exit;
    }
  }
  const auto found = find_newer(link, std::nullopt);
  if (found && !told)
    return work_with_newer(context, link, *found, given, talks);
  fail(context, found ? name_robot(link, given, {ExitCode::Usage, "the robot speaks v2 packets"})
                      : found.error());
  return context.exit;
}

} // namespace

void add_robot_option(const Command& command, std::string& robot) {
  command
      .add_option("--robot", robot,
                  "which robot answers there; by default its name tells, or it is asked")
      .check(one_of(names_of(spec::robots)));
}

std::optional<spec::Robot> told_robot(const Link& link, std::string_view robot) {
  const auto* row = spec::find_robot(robot);
  return row != nullptr ? std::optional(row->robot) : link.named;
}

Newer newer_of(spec::Robot robot) {
  return {spec::info(robot), std::string(spec::info(robot).title)};
}

tl::expected<Newer, Failure> find_newer(Link& link, std::optional<spec::Robot> told) {
  if (told)
    return newer_of(*told);
  const auto fitting = run::fitting_robots(*link.transport);
  if (!fitting)
    return tl::unexpected(fitting.error());
  if (!alike(*fitting))
    return tl::unexpected(run::only_one(*fitting).error());
  return Newer{spec::info(fitting->front()), titles(*fitting)};
}

void with_robot(Context& context, const PortOptions& options, std::string_view robot,
                const Talks& talks) {
  const InterruptGuard guard;
  auto port = options;
  if (const auto* row = spec::find_robot(robot))
    port.robot = row->robot;
  auto link = open_link(context, port);
  if (!link)
    return fail(context, link.error());
  context.exit = work_with(context, *link, robot, talks);
  context.exit = link->finish(context, context.exit);
}

void with_firmware(
    Context& context, const PortOptions& options,
    const std::function<ExitCode(Link&, uploader::Session&, const uploader::Greeting&)>& work) {
  const auto classic = [&](Link& link, uploader::Session& session,
                           const uploader::Greeting& greeting) {
    if (const auto refused = refuse_bootloader(greeting, link.name)) {
      print_error(context, refused->message);
      return exit_code(refused->kind);
    }
    return work(link, session, greeting);
  };
  const auto newer = [&](Link&, run::TalkV2&, const Newer& robot) -> tl::expected<void, Failure> {
    return tl::unexpected(stores_nothing(robot, options.port));
  };
  with_robot(context, options, {}, {classic, newer});
}

std::string with_article(std::string_view title) {
  const bool vowel = title.starts_with("R2") || title.starts_with("O");
  return fmt::format("{} {}", vowel ? "an" : "a", title);
}

Failure stores_nothing(const Newer& robot, std::string_view port) {
  return {ExitCode::Refused,
          fmt::format("the robot is {}, which stores no programs; drive it from here: `orb run "
                      "PROGRAM --port {}`",
                      with_article(robot.title), port)};
}

Failure name_robot(Link& link, std::string_view robot, Failure failure) {
  const auto* given = spec::find_robot(robot);
  if (given == nullptr || link.is_sim || failure.code == ExitCode::Interrupted)
    return failure;
  const auto there = who_is_there(link);
  const auto is_given = [&](spec::Robot one) {
    const auto& row = spec::info(one);
    return row.robot == given->robot || (!is_newer(one) && !is_newer(given->robot));
  };
  if (there.empty() || std::any_of(there.begin(), there.end(), is_given))
    return failure;
  failure.message +=
      fmt::format("; the robot is {}: omit `--robot {}`, or write `--robot {}`",
                  with_article(titles(there)), given->name, spec::info(there.front()).name);
  return failure;
}

} // namespace orb::cli
