#include "run/tether/drive_home.h"

#include "spec/ball.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orb::run {
namespace {

constexpr double near_cm = 6;
constexpr Duration patience = 20s;
constexpr Duration no_progress = 3s; ///< longest time without getting closer
constexpr double progress_cm = 2;
constexpr Duration turn = 1500ms; ///< for the final turn

double distance(const vm::Sample& sample) {
  return std::hypot(sample.place_cm.x, sample.place_cm.y);
}

/// Drives toward 0,0. Slows down on approach, because the robot rolls on.
vm::Roll toward_home(const vm::Sample& sample) {
  constexpr double slowest = 25;
  constexpr double fastest = 60;
  const double heading =
      std::atan2(-sample.place_cm.x, -sample.place_cm.y) * 180 / std::numbers::pi;
  return {(static_cast<int>(std::lround(heading)) + spec::ball::full_circle) %
              spec::ball::full_circle,
          static_cast<int>(std::clamp(distance(sample), slowest, fastest)), vm::Go::Drive};
}

bool rests(const vm::Sample& sample) {
  constexpr double crawl_cm_s = 1;
  return std::hypot(sample.velocity_cm_s.x, sample.velocity_cm_s.y) < crawl_cm_s;
}

/// Drives by its samples until the robot rests near 0,0.
tl::expected<Home, Failure> approach(Tether& robot, vm::Sample sample) {
  const auto until = robot.now() + patience;
  double nearest = distance(sample);
  auto nearest_at = robot.now();
  bool braked = false;
  while (distance(sample) > near_cm || !rests(sample)) {
    if (robot.now() >= until || robot.now() - nearest_at > no_progress)
      return Home::Missed;
    if (distance(sample) > near_cm && (!braked || rests(sample))) {
      robot.obey(toward_home(sample));
      braked = false;
    } else if (!braked) {
      robot.obey(vm::Roll{toward_home(sample).heading_deg, 0, vm::Go::Brake});
      braked = true;
    }
    const auto hear = [&](const RobotMessage& said) {
      if (const auto* felt = std::get_if<vm::Sample>(&said.what))
        sample = *felt;
    };
    constexpr Duration glance = 20ms;
    if (auto pumped = robot.pump(robot.now() + glance, hear); !pumped)
      return tl::unexpected(pumped.error());
    if (distance(sample) < nearest - progress_cm || braked) {
      nearest = std::min(nearest, distance(sample));
      nearest_at = robot.now();
    }
  }
  return Home::Reached;
}

} // namespace

tl::expected<Home, Failure> drive_home(protocol::Transport& transport,
                                       const TetherOptions& tether) {
  Tether robot(transport, tether.robot, tether.budgets, {}, tether.reopen);
  const auto first = robot.begin(Aim::Keep);
  if (!first)
    return tl::unexpected(first.error());
  auto home = approach(robot, *first);
  if (home == Home::Reached) {
    robot.obey(vm::Roll{0, 0, vm::Go::Drive});
    for (const auto until = robot.now() + turn; robot.now() < until;)
      if (auto pumped = robot.pump(until, [](const RobotMessage&) {}); !pumped)
        return tl::unexpected(pumped.error());
  }
  robot.finish();
  return home;
}

} // namespace orb::run
