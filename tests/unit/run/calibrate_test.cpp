#include "run/calibrate/fit.h"

#include "base/random.h"
#include "vm/body/body.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

namespace orb::run {
namespace {

/// A robot with hidden parameters, noisy samples and gaps in them.
class Hidden final : public HeldRobot {
public:
  explicit Hidden(const spec::Driving& numbers, Duration between = 30ms, double lost = 0.02,
                  std::uint64_t seed = 7)
      : body_(1, numbers), between_(between), lost_(lost), random_(seed) {}

  double noise_cm = 0.5;
  double noise_deg = 1;
  int deaf_at = -1; ///< index of an order that is lost
  bool held_fast = false;
  bool braked = false;
  Duration silent_from{};
  Duration silent_until{};
  std::function<void(vm::Sample&)> twist = [](auto&) {};   ///< falsifies samples
  std::function<void(vm::Motion&)> mistake = [](auto&) {}; ///< falsifies orders
  /// Along an axis, from its starting place.
  double farthest_cm = 0;

  void obey(const vm::Motion& motion) override {
    const auto* roll = std::get_if<vm::Roll>(&motion);
    braked = roll != nullptr && roll->go == vm::Go::Brake;
    auto heard = motion;
    mistake(heard);
    if (orders_++ != deaf_at && !held_fast)
      body_.obey(heard);
  }
  void show(vm::Color) override {}
  void show_back(int) override {}
  const vm::Sample& first() const override { return first_; }
  Duration time() const override { return now_; }
  tl::expected<void, Failure> go_on(Duration) override { return {}; }
  tl::expected<void, Failure> hold() override { return {}; }
  tl::expected<std::vector<Felt>, Failure> hear(Duration until) override {
    now_ = std::min(until, next_);
    body_.advance_to(Instant{} + now_);
    if (now_ < next_)
      return std::vector<Felt>{};
    next_ += between_;
    std::vector<Felt> felt;
    const auto pose = body_.pose();
    farthest_cm = std::max({farthest_cm, std::abs(pose.x_cm), std::abs(pose.y_cm)});
    if (draw(1) >= lost_ && (now_ < silent_from || now_ >= silent_until)) {
      vm::Sample sample;
      sample.place_cm = {pose.x_cm + noise(noise_cm), pose.y_cm + noise(noise_cm)};
      sample.yaw_deg = std::fmod(body_.yaw_deg() + noise(noise_deg) + 360, 360);
      twist(sample);
      felt.emplace_back(sample);
    }
    return felt;
  }

private:
  double draw(double most) {
    constexpr std::uint64_t grain = 1'000'000;
    return most * static_cast<double>(random_.below(grain)) / grain;
  }
  /// Approximately normal: the sum of three uniform numbers.
  double noise(double sigma) { return sigma * 2 * (draw(1) + draw(1) + draw(1) - 1.5); }

  vm::Body body_;
  Duration between_;
  double lost_;
  vm::Sample first_;
  Duration now_{};
  Duration next_{};
  int orders_ = 0;
  Random random_;
};

/// Returns the model's parameters, each multiplied.
spec::Driving changed(spec::Robot robot, const std::array<double, driving_rows.size()>& times) {
  const auto model = spec::driving(robot);
  auto numbers = model;
  for (std::size_t row = 0; row < driving_rows.size(); ++row)
    set_value(numbers, driving_rows[row], value_of(model, driving_rows[row]) * times[row]);
  return numbers;
}

Duration sample_time(spec::Robot robot) {
  return robot == spec::Robot::Mini ? 60ms : 30ms;
}

vm::Point end_of_square(const spec::Driving& numbers) {
  vm::Body body(1, numbers);
  for (int side = 0; side < 4; ++side) {
    body.obey(vm::Roll{side * 90, 60, vm::Go::Drive});
    body.advance_to(Instant{} + (side + 1) * 2s);
  }
  return body.locator_cm();
}

double apart(vm::Point a, vm::Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

constexpr std::array<double, driving_rows.size()> changes[] = {
    {1.4, 1.4, 1.4, 1.4, 1.4, 1.4}, {0.7, 0.7, 0.7, 0.7, 0.7, 0.7}, {0.7, 1.4, 0.7, 1.4, 0.7, 1.4},
    {1.4, 0.7, 1.4, 0.7, 1.4, 0.7}, {1.2, 0.9, 1.3, 0.7, 1.1, 1.0}, {1, 1, 1, 1, 1, 1},
};

/// Expects each parameter within 5 %, and a square driven with them to end four times closer.
void expect_found(const spec::Driving& hidden, const Calibration& found) {
  std::string all;
  for (std::size_t row = 0; row < driving_rows.size(); ++row) {
    const double is = value_of(hidden, driving_rows[row]);
    const double said = value_of(found.after, driving_rows[row]);
    EXPECT_NEAR(said / is, 1, 0.05) << driving_rows[row].name;
    all += fmt::format(" {} {:+.1f} % (spread {:.1f} %)", driving_rows[row].name,
                       100 * (said / is - 1), 100 * found.spread[row] / is);
  }
  const double before = apart(end_of_square(hidden), end_of_square(found.before));
  const double after = apart(end_of_square(hidden), end_of_square(found.after));
  constexpr double tiny_cm = 0.5; // a correct value cannot improve
  EXPECT_LT(after, std::max(tiny_cm, before / 4)) << all;
  fmt::print("{}; square {:.1f} cm, {:.1f} cm\n", all, before, after);
}

TEST(Calibrate, FindsHiddenNumbersInStreamsWithNoiseAndLosses) {
  for (const auto robot : {spec::Robot::Sphero, spec::Robot::Mini})
    for (const auto& times : changes) {
      const auto hidden = changed(robot, times);
      Hidden far(hidden, sample_time(robot));
      const auto legs = drive_course(far, robot, {});
      ASSERT_TRUE(legs.has_value()) << legs.error().message;
      EXPECT_TRUE(far.braked);
      const auto found = fit(*legs, robot);
      ASSERT_TRUE(found.has_value()) << found.error().message;
      expect_found(hidden, *found);
    }
}

double between(Random& random, double least, double most) {
  constexpr std::uint64_t grain = 1'000'000;
  return least + (most - least) * static_cast<double>(random.below(grain)) / grain;
}

/// Returns random parameters, for a robot that the model does not know.
spec::Driving random_numbers(spec::Robot robot, Random& random) {
  auto numbers = spec::driving(robot);
  numbers.speed_offset = between(random, 0, 30);
  numbers.speed_slope *= std::exp2(between(random, -1, 1));
  numbers.speed_lag = between(random, 0, 0.4);
  numbers.dead_steps = static_cast<int>(between(random, 0, 150) / dead_step_ms);
  numbers.turn_gain *= between(random, 0.5, 1.5);
  numbers.grip *= std::exp2(between(random, -1, 1));
  return numbers;
}

/// Lists parameters more than 10 % off: of their value or, because offset, lag and dead time may be
/// 0, of the model's.
std::string off(const Calibration& found, const spec::Driving& hidden) {
  std::string text;
  for (std::size_t row = 0; row < driving_rows.size(); ++row) {
    const auto& info = driving_rows[row];
    const bool may_be_0 = info.place != &spec::Driving::speed_slope &&
                          info.place != &spec::Driving::turn_gain &&
                          info.place != &spec::Driving::grip;
    const double is = value_of(hidden, info);
    const double said = value_of(found.after, info);
    const double tolerance = 0.1 * std::max(is, may_be_0 ? value_of(found.before, info) : 0);
    if (std::abs(said - is) > tolerance)
      text +=
          fmt::format(" {} {:.3g} ± {:.2g}, not {:.3g};", info.name, said, found.spread[row], is);
  }
  return text;
}

/// Expects a course that was not refused and stayed in the square, and a profile that survives a
/// round trip.
Calibration calibrated(Hidden& far, spec::Robot robot) {
  const auto legs = drive_course(far, robot, {});
  EXPECT_TRUE(legs.has_value()) << legs.error().message;
  EXPECT_LE(far.farthest_cm, square_half_cm);
  const auto found = legs ? fit(*legs, robot) : tl::unexpected(legs.error());
  EXPECT_TRUE(found.has_value()) << found.error().message;
  if (!found)
    return {};
  EXPECT_EQ(found->doubt, "");
  const auto text = to_text({robot, found->after, found->slowest, found->fastest});
  const auto read = parse_profile(text);
  EXPECT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(read ? to_text(*read) : "", text);
  return *found;
}

TEST(Calibrate, FindsNumbersHoweverFarFromTheModels) {
  constexpr int each = 16;
  Random random{20};
  int good = 0;
  int bodies = 0;
  for (const auto robot :
       {spec::Robot::Sphero, spec::Robot::Mini, spec::Robot::Bolt, spec::Robot::Rvr})
    for (int body = 0; body < each; ++body) {
      SCOPED_TRACE(fmt::format("{} {}", spec::info(robot).name, body));
      const auto hidden = random_numbers(robot, random);
      Hidden far(hidden, sample_time(robot), 0.02, random.below(1000));
      const auto wrong = off(calibrated(far, robot), hidden);
      ++bodies;
      good += wrong.empty() ? 1 : 0;
      if (!wrong.empty())
        fmt::print("{} {}:{}\n", spec::info(robot).name, body, wrong);
    }
  fmt::print("{} of {} bodies within 10 %\n", good, bodies);
  EXPECT_GE(60 * good, 55 * bodies);
}

TEST(Calibrate, FindsNumbersAtTheEnds) {
  for (const auto robot : {spec::Robot::Sphero, spec::Robot::Mini}) {
    auto prompt = spec::driving(robot);
    prompt.speed_offset = prompt.speed_lag = 0;
    prompt.dead_steps = 0;
    Hidden at_once(prompt, sample_time(robot));
    EXPECT_EQ(off(calibrated(at_once, robot), prompt), "");
    auto late = spec::driving(robot);
    late.speed_offset = -15 * late.speed_slope; // it does not move below 15
    late.speed_lag = 1;
    late.dead_steps = 100;
    Hidden slowly(late, sample_time(robot));
    EXPECT_EQ(off(calibrated(slowly, robot), late), "");
    auto railed = spec::driving(robot);
    railed.grip = 5000;
    Hidden on_rails(railed, sample_time(robot));
    EXPECT_GT(calibrated(on_rails, robot).after.grip, 3 * spec::driving(robot).grip);
  }
}

/// Parameters of the fastest robot that can be measured.
spec::Driving fast_numbers() {
  auto numbers = spec::driving(spec::Robot::Sphero);
  numbers.speed_offset = 30;
  numbers.speed_slope *= 2;
  numbers.speed_lag = 0;
  numbers.dead_steps = 0;
  return numbers;
}

TEST(Calibrate, AnOllieIsMeasuredAsASpheroToo) {
  const auto hidden = spec::driving(spec::Robot::Ollie);
  for (const auto robot : {spec::Robot::Ollie, spec::Robot::Sphero}) {
    Hidden far(hidden);
    EXPECT_EQ(off(calibrated(far, robot), hidden), "");
  }
}

TEST(Calibrate, AFastRobotStaysInTheSquareThoughTheFirstLegsTellNothing) {
  Hidden silent(fast_numbers());
  silent.silent_from = 1s;
  silent.silent_until = 1400ms;
  EXPECT_EQ(calibrated(silent, spec::Robot::Sphero).used, 23U);
  Hidden deaf(fast_numbers());
  deaf.deaf_at = 1; // the first straight
  EXPECT_EQ(calibrated(deaf, spec::Robot::Sphero).used, 23U);
}

TEST(Calibrate, ANumberThatTheLegsLeaveOpenStaysTheModels) {
  const auto robot = spec::Robot::Sphero;
  const auto hidden = changed(robot, changes[0]);
  std::vector<Leg> alike;
  for (const std::uint64_t seed : {1U, 2U}) {
    Hidden far(hidden, 30ms, 0.02, seed);
    const auto legs = drive_course(far, robot, {});
    ASSERT_TRUE(legs.has_value()) << legs.error().message;
    for (const auto& leg : *legs)
      if (leg.orders[1].speed == spec::ball::slowest_driven)
        alike.push_back(leg);
  }
  const auto found = fit(alike, robot);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found->doubt, "");
  // One of the two speed parameters is open: the other determines the speed of these legs.
  EXPECT_NE(found->open[0], found->open[1]);
  for (std::size_t row = 0; row < driving_rows.size(); ++row)
    if (found->open[row]) {
      EXPECT_EQ(value_of(found->after, driving_rows[row]),
                value_of(found->before, driving_rows[row]));
    }
  EXPECT_NEAR(spec::speed_cm_s(found->after, spec::ball::slowest_driven),
              spec::speed_cm_s(hidden, spec::ball::slowest_driven), 1);
}

TEST(Calibrate, ALegWhoseOrderWasLostIsLeftOut) {
  const auto hidden = changed(spec::Robot::Sphero, changes[4]);
  Hidden far(hidden);
  far.deaf_at = 10; // the bend of the third leg
  const auto legs = drive_course(far, spec::Robot::Sphero, {});
  ASSERT_TRUE(legs.has_value()) << legs.error().message;
  const auto found = fit(*legs, spec::Robot::Sphero);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found->used, found->legs - 1);
  expect_found(hidden, *found);
}

/// Returns why a drive or its parameters are refused. The parameters exist all the same.
std::string refusal(Hidden& far, spec::Robot robot) {
  const auto legs = drive_course(far, robot, {});
  if (!legs)
    return legs.error().message;
  const auto found = fit(*legs, robot);
  if (!found)
    return found.error().message;
  EXPECT_GT(found->error_after_cm, 0);
  EXPECT_NE(found->after.turn_gain, 0);
  return found->doubt;
}

TEST(Calibrate, RefusesWhatADriveDoesNotTell) {
  Hidden silent(spec::driving(spec::Robot::Sphero), 30ms, 0.95);
  EXPECT_EQ(
      refusal(silent, spec::Robot::Sphero),
      "only 0 of 24 legs are usable; the link lost the others; move closer to the robot and try "
      "again");
  for (const auto robot : {spec::Robot::Sphero, spec::Robot::Mini}) {
    Hidden still(spec::driving(robot));
    still.held_fast = true;
    EXPECT_NE(refusal(still, robot).find("nothing is holding it back"), std::string::npos);
  }
  auto faster = spec::driving(spec::Robot::Ollie);
  faster.speed_offset *= 2;
  Hidden another(faster);
  EXPECT_NE(refusal(another, spec::Robot::Sphero).find("too fast to be measured"),
            std::string::npos);
}

TEST(Calibrate, RefusesWhatTheModelDoesNotExplain) {
  for (const auto robot : {spec::Robot::Sphero, spec::Robot::Mini}) {
    Hidden mirrored(spec::driving(robot));
    mirrored.twist = [](vm::Sample& sample) {
      sample.yaw_deg = std::fmod(360 - sample.yaw_deg, 360);
    };
    EXPECT_NE(refusal(mirrored, robot).find("the model does not fit this drive"),
              std::string::npos);
    Hidden slippery(spec::driving(robot));
    Random random{1};
    slippery.mistake = [&](vm::Motion& motion) {
      if (auto* roll = std::get_if<vm::Roll>(&motion))
        roll->speed = static_cast<int>(roll->speed * between(random, 0, 2));
    };
    EXPECT_NE(refusal(slippery, robot).find("the model"), std::string::npos);
    Hidden one_speed(spec::driving(robot));
    one_speed.mistake = [](vm::Motion& motion) {
      if (auto* roll = std::get_if<vm::Roll>(&motion))
        roll->speed = roll->speed == 0 ? 0 : 40;
    };
    EXPECT_NE(refusal(one_speed, robot).find("no robot has a `speed_slope` of 0.01"),
              std::string::npos);
  }
}

TEST(Calibrate, NoiseIsNoMisfit) {
  for (const auto robot : {spec::Robot::Sphero, spec::Robot::Mini}) {
    Hidden far(spec::driving(robot), sample_time(robot));
    far.noise_cm = 4;
    EXPECT_GT(calibrated(far, robot).error_after_cm, 4);
  }
}

TEST(Calibrate, AProfileIsReadAsItWasWritten) {
  Profile profile{spec::Robot::Mini, changed(spec::Robot::Mini, changes[4]), 20, 60};
  const auto text = to_text(profile);
  const auto read = parse_profile(text);
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(to_text(*read), text);
  EXPECT_EQ(read->robot, spec::Robot::Mini);
  EXPECT_EQ(read->fastest, 60);
}

} // namespace
} // namespace orb::run
