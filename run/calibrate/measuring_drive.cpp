#include "run/calibrate/measuring_drive.h"

#include "base/refuse.h"
#include "run/calibrate/fit.h"
#include "vm/body/angles.h"
#include "vm/body/body.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace orb::run {
namespace {

constexpr int legs = 24;
constexpr Duration to_turn = 700ms; ///< in place, before a leg
constexpr Duration to_bend = 600ms; ///< drive after the bend
constexpr Duration to_rest = 900ms; ///< wait after braking
constexpr Duration longest_gap = 300ms;
constexpr double straight_cm = 50;  ///< approximate distance before the bend
constexpr double shortest_s = 0.75; ///< less than the tether's repetition interval
constexpr double longest_s = 1.5;
constexpr double fastest_cm_s = 75;  ///< comfortable within the square
constexpr double too_fast_cm_s = 95; ///< for the lowest speed
constexpr int least_range = 12;      ///< of ordered speeds, to fit a line
constexpr std::size_t least_seen = 12;
constexpr std::size_t known_after = 6; ///< legs used to estimate the robot's speed

/// Bends of the legs: to both sides, and not always by a right angle.
constexpr int bends_deg[] = {90, -90, 120, -60, 60, -120};
/// Order of the speeds, in sixths of the range: from slow to fast while the robot's speed is
/// unknown.
constexpr int sixths[] = {0, 2, 4, 6, 3, 5, 1, 6, 0, 4, 3, 6};

struct Shape {
  int speed = 0;
  int bend_deg = 0;
  vm::Go bend = vm::Go::Drive;
  Duration straight{};
};

/// Returns the highest speed to order from a robot with these parameters.
int fastest_speed(const spec::Driving& numbers) {
  int fastest = spec::ball::fastest_driven;
  while (fastest > spec::ball::slowest_driven + least_range &&
         spec::speed_cm_s(numbers, fastest) > fastest_cm_s)
    --fastest;
  return fastest;
}

Shape shape_of(std::size_t leg, const spec::Driving& numbers) {
  constexpr int slowest = spec::ball::slowest_driven;
  const int share = sixths[leg % std::size(sixths)];
  const int speed = slowest + (fastest_speed(numbers) - slowest) * share / 6;
  double straight = straight_cm / std::max(spec::speed_cm_s(numbers, speed), 1.0);
  straight = std::clamp(straight, shortest_s, longest_s);
  // Keep the first legs short: the model may underestimate the robot, and an order may be lost. An
  // order is repeated after 0.8 s, so no other order may fall near that time.
  if (leg < 3 || straight < shortest_s + 0.2)
    straight = shortest_s;
  // A slow turn causes no slip and so reveals nothing about grip.
  const auto bend = leg % 4 == 1 ? vm::Go::FastTurn : vm::Go::Drive;
  return {speed, bends_deg[leg % std::size(bends_deg)], bend,
          Duration{static_cast<Duration::rep>(straight * 1e9)}};
}

/// Simulates a leg toward heading 0 that begins at 0,0.
std::vector<vm::Point> way_of(const Shape& shape, const spec::Driving& numbers) {
  vm::Body body(1, numbers);
  std::vector<vm::Point> way;
  const auto live = [&](Duration from, Duration until) {
    for (auto at = from; at < until; at += 100ms) {
      body.advance_to(Instant{} + at);
      way.push_back(body.locator_cm());
    }
  };
  const int bent = (shape.bend_deg + spec::ball::full_circle) % spec::ball::full_circle;
  body.obey(vm::Roll{0, shape.speed, vm::Go::Drive});
  live(0ms, shape.straight);
  body.obey(vm::Roll{bent, shape.speed, shape.bend});
  live(shape.straight, shape.straight + to_bend);
  body.obey(vm::Roll{bent, 0, vm::Go::Brake});
  live(shape.straight + to_bend, shape.straight + to_bend + to_rest);
  return way;
}

/// Rates how far a leg from `place` toward `heading` strays from the middle: the farthest point
/// plus the last one, so that a good last point counts twice. Assumes that the robot may go half as
/// far again as the model.
double farthest(std::span<const vm::Point> way, vm::Point place, int heading) {
  const double sine = std::sin(heading * vm::to_radians);
  const double cosine = std::cos(heading * vm::to_radians);
  double far = 0;
  double last = 0;
  for (const double times : {1.0, 1.5})
    for (const auto& at : way) {
      last = std::max(std::abs(place.x + times * (at.x * cosine + at.y * sine)),
                      std::abs(place.y + times * (at.y * cosine - at.x * sine)));
      far = std::max(far, last);
    }
  return far + last;
}

/// Returns the heading that keeps the leg from `place` closest to the middle.
int best_heading(std::span<const vm::Point> way, vm::Point place) {
  constexpr int grain = 15;
  constexpr double better = 1e-6; // ties go to the first, on every machine
  int best = 0;
  double least = HUGE_VAL;
  for (int heading = 0; heading < spec::ball::full_circle; heading += grain)
    if (const double far = farthest(way, place, heading); far < least - better) {
      least = far;
      best = heading;
    }
  return best;
}

class MeasuringDrive {
public:
  MeasuringDrive(HeldRobot& robot, spec::Robot which)
      : robot_(robot), which_(which), numbers_(spec::driving(which)),
        place_(robot.first().place_cm), middle_(place_) {}

  tl::expected<Leg, Failure> drive() {
    const auto shape = shape_of(told_, numbers_);
    const int heading = best_heading(way_of(shape, numbers_), from_middle());
    const int bent = (heading + shape.bend_deg + spec::ball::full_circle) % spec::ball::full_circle;
    leg_ = {};
    began_ = robot_.time();
    const std::pair<Order, Duration> plan[] = {{{{}, heading, 0}, to_turn},
                                               {{{}, heading, shape.speed}, shape.straight},
                                               {{{}, bent, shape.speed, shape.bend}, to_bend}};
    auto until = began_;
    for (const auto& [order, time] : plan) {
      give(order);
      until += time;
      if (auto heard = hear(until); !heard)
        return tl::unexpected(heard.error());
    }
    auto leg = std::move(leg_);
    robot_.obey(vm::Roll{bent, 0, vm::Go::Brake});
    if (auto heard = hear(until + to_rest); !heard)
      return tl::unexpected(heard.error());
    leg.broken = leg.broken || leg.seen.size() < least_seen;
    if (auto learnt = learn(leg); !learnt)
      return tl::unexpected(learnt.error());
    return leg;
  }

private:
  vm::Point from_middle() const { return {place_.x - middle_.x, place_.y - middle_.y}; }

  /// A broken leg is driven again: no leg may be faster before the slow ones have shown how fast
  /// this robot is.
  tl::expected<void, Failure> learn(const Leg& leg) {
    if (leg.broken)
      return {};
    ++told_;
    if (first_.size() == known_after)
      return {};
    first_.push_back(leg);
    numbers_ = with_speeds_of(first_, which_);
    constexpr int slowest = spec::ball::slowest_driven;
    if (const double speed = spec::speed_cm_s(numbers_, slowest); speed > too_fast_cm_s)
      return refuse(ExitCode::Refused, fmt::format("this robot is too fast to be measured in 2 m x "
                                                   "2 m: at speed {} it does {:.0f} cm/s",
                                                   slowest, speed));
    return {};
  }

  void give(Order order) {
    order.at = robot_.time() - began_;
    leg_.orders.push_back(order);
    robot_.obey(vm::Roll{order.heading_deg, order.speed, order.go});
  }

  tl::expected<void, Failure> hear(Duration until) {
    while (robot_.time() < until) {
      const auto felt = robot_.hear(until);
      if (!felt)
        return tl::unexpected(felt.error());
      for (const auto& one : *felt)
        if (std::holds_alternative<vm::event::Collision>(one))
          return refuse(ExitCode::Refused, "the robot ran into something; clear 2 m x 2 m of floor "
                                           "and begin again");
        else if (const auto* sample = std::get_if<vm::Sample>(&one))
          take(*sample);
      const auto here = from_middle();
      if (std::max(std::abs(here.x), std::abs(here.y)) > square_half_cm)
        return refuse(ExitCode::Refused,
                      "the robot left the 2 m x 2 m area; put it in the middle of a "
                      "level floor, facing along one side, and begin again");
    }
    return {};
  }

  void take(const vm::Sample& sample) {
    place_ = sample.place_cm;
    const auto at = robot_.time() - began_;
    const auto before = leg_.seen.empty() ? Duration{} : leg_.seen.back().at;
    leg_.broken = leg_.broken || at - before > longest_gap;
    leg_.seen.push_back({at, sample.place_cm, sample.yaw_deg});
  }

  HeldRobot& robot_;
  spec::Robot which_;
  spec::Driving numbers_;  ///< present estimate
  std::size_t told_ = 0;   ///< usable legs
  std::vector<Leg> first_; ///< the first usable legs
  vm::Point place_;
  vm::Point middle_;
  Duration began_{};
  Leg leg_;
};

} // namespace

Duration course_time() {
  const Duration straight{static_cast<Duration::rep>(longest_s * 1e9)};
  return legs * (to_turn + straight + to_bend + to_rest);
}

tl::expected<std::vector<Leg>, Failure> drive_course(HeldRobot& robot, spec::Robot which,
                                                     const std::function<void(int, int)>& tell) {
  if (auto goes = robot.go_on({}); !goes)
    return tl::unexpected(goes.error());
  MeasuringDrive course(robot, which);
  std::vector<Leg> driven;
  while (driven.size() < legs) {
    auto leg = course.drive();
    if (!leg)
      return tl::unexpected(leg.error());
    driven.push_back(*std::move(leg));
    if (tell)
      tell(static_cast<int>(driven.size()), legs);
  }
  return driven;
}

} // namespace orb::run
