#include "cli/robot/driven_robot.h"

#include "run/tether/find_robot.h"
#include "run/tether/hold_robot.h"

namespace orb::cli {
namespace {

constexpr Duration patience = 6s; // for a robot to say what it is

tl::expected<spec::Robot, Failure> kind_of(const Link& link, const PortOptions& port,
                                           const std::string& name) {
  if (!name.empty() || link.is_sim)
    return port.robot;
  if (link.named)
    return *link.named;
  if (link.packets == spec::Packets::V2)
    return run::find_newer_robot(*link.transport);
  return run::find_robot(*link.transport, patience);
}

} // namespace

tl::expected<std::unique_ptr<DrivenRobot>, Failure>
connect_robot(const Context& context, const PortOptions& given, const std::string& name) {
  auto port = given;
  if (!name.empty())
    port.robot = spec::find_robot(name)->robot; // the options are checked
  auto opened = open_link(context, port);
  if (!opened)
    return tl::unexpected(opened.error());
  auto robot = std::make_unique<DrivenRobot>();
  robot->link = *std::move(opened);
  const auto kind = kind_of(robot->link, port, name);
  if (!kind)
    return tl::unexpected(kind.error());
  robot->tether.robot = *kind;
  robot->tether.note = [&context](const std::string& message) { print_note(context, message); };
  if (!robot->link.is_sim)
    robot->tether.reopen = [&context, port,
                            &again = robot->again]() -> std::unique_ptr<protocol::Transport> {
      auto second = open_link(context, port);
      if (!second)
        return nullptr;
      again = std::make_unique<Link>(*std::move(second));
      return std::move(again->transport);
    };
  return robot;
}

tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
hold_robot(const Context& context, const PortOptions& port, const std::string& name) {
  struct Both {
    std::unique_ptr<DrivenRobot> robot;
    std::unique_ptr<run::HeldRobot> held; // goes first: it still speaks to the robot
  };
  auto robot = connect_robot(context, port, name);
  if (!robot)
    return tl::unexpected(robot.error());
  auto held = run::hold_robot(*(*robot)->link.transport, (*robot)->tether);
  if (!held)
    return tl::unexpected(held.error());
  const auto both = std::make_shared<Both>();
  both->robot = *std::move(robot);
  both->held = *std::move(held);
  return std::shared_ptr<run::HeldRobot>(both, both->held.get());
}

} // namespace orb::cli
