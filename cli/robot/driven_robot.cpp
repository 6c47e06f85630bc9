#include "cli/robot/driven_robot.h"

#include "base/duration.h"
#include "cli/robot/reach.h"
#include "run/tether/find_robot.h"
#include "run/tether/hold_robot.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

namespace orb::cli {
namespace {

constexpr Duration introduction_time = 6s; // for a robot to identify itself

tl::expected<spec::Robot, Failure> kind_of(const Link& link, const PortOptions& port,
                                           const std::string& name) {
  if (!name.empty() || link.is_sim)
    return port.robot;
  if (link.named)
    return *link.named;
  if (link.packets == spec::Packets::V2)
    return run::find_newer_robot(*link.transport);
  return run::find_robot(*link.transport, introduction_time);
}

using Clock = std::chrono::steady_clock;

/// Opens the port again after a link was lost, until `until`. After the first link it tries at
/// least once.
std::unique_ptr<protocol::Transport> open_again(const Context& context, const PortOptions& port,
                                                DrivenRobot& robot, Clock::time_point until) {
  constexpr auto pause = std::chrono::milliseconds{100};
  const int asked = InterruptGuard::asked();
  const bool reopened = robot.again != nullptr;
  (reopened ? *robot.again : robot.link).stopper->close(); // a device has a single user at a time
  if (reopened)
    std::this_thread::sleep_for(pause);
  if (reopened && Clock::now() >= until)
    return nullptr;
  do {
    if (auto again = open_link(context, port)) {
      robot.again = std::make_unique<Link>(*std::move(again));
      return std::move(robot.again->transport);
    }
    std::this_thread::sleep_for(pause);
  } while (Clock::now() < until && InterruptGuard::asked() == asked);
  return nullptr;
}

} // namespace

tl::expected<std::unique_ptr<DrivenRobot>, Failure>
connect_robot(const Context& context, const PortOptions& given, const std::string& name) {
  auto port = given;
  if (!name.empty())
    port.robot = spec::find_robot(name)->robot; // the options have been checked
  auto opened = open_link(context, port);
  if (!opened)
    return tl::unexpected(opened.error());
  auto robot = std::make_unique<DrivenRobot>();
  robot->link = *std::move(opened);
  const auto kind = kind_of(robot->link, port, name);
  if (!kind)
    return tl::unexpected(kind.error());
  robot->tether.robot = *kind;
  robot->tether.budgets.stale = *parse_duration(port.stale, 1s); // the options have been checked
  robot->tether.budgets.gone =
      std::max(robot->tether.budgets.gone, 2 * robot->tether.budgets.stale);
  robot->tether.budgets.collisions = {port.collision_threshold, port.collision_threshold};
  robot->tether.note = [&context](const std::string& message) { print_note(context, message); };
  if (!robot->link.is_sim)
    robot->tether.reopen = [&context, port, &robot = *robot,
                            until = std::optional<Clock::time_point>{}]() mutable {
      if (!until)
        until = Clock::now() + spec::v2_drive_timeout + robot.link.budgets.answer;
      return open_again(context, port, robot, *until);
    };
  return robot;
}

tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
hold_robot(const Context& context, const PortOptions& port, const std::string& name) {
  struct Both {
    std::unique_ptr<DrivenRobot> robot;
    std::unique_ptr<run::HeldRobot> held; // destroyed first: it still talks to the robot
  };
  auto robot = connect_robot(context, port, name);
  if (!robot)
    return tl::unexpected(robot.error());
  auto held = run::hold_robot(*(*robot)->link.transport, (*robot)->tether);
  if (!held)
    return tl::unexpected(name_robot((*robot)->link, name, held.error()));
  const auto both = std::make_shared<Both>();
  both->robot = *std::move(robot);
  both->held = *std::move(held);
  return std::shared_ptr<run::HeldRobot>(both, both->held.get());
}

} // namespace orb::cli
