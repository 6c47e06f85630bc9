#include "run/calibrate/fit.h"

#include "base/random.h"
#include "vm/body/body.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace orb::run {
namespace {

/// A robot with numbers of its own, which trembles in what it says and loses some of it.
class Hidden final : public HeldRobot {
public:
  explicit Hidden(const spec::Driving& numbers, Duration between = 30ms, double lost = 0.02)
      : body_(1, numbers), between_(between), lost_(lost) {}

  double noise_cm = 0.5;
  double noise_deg = 1;
  int deaf_at = -1; ///< this order does not arrive
  bool held_fast = false;
  bool braked = false;

  void obey(const vm::Motion& motion) override {
    const auto* roll = std::get_if<vm::Roll>(&motion);
    braked = roll != nullptr && roll->go == vm::Go::Brake;
    if (orders_++ != deaf_at && !held_fast)
      body_.obey(motion);
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
    if (draw(1) >= lost_) {
      const auto pose = body_.pose();
      vm::Sample sample;
      sample.place_cm = {pose.x_cm + noise(noise_cm), pose.y_cm + noise(noise_cm)};
      sample.yaw_deg = std::fmod(body_.yaw_deg() + noise(noise_deg) + 360, 360);
      felt.emplace_back(sample);
    }
    return felt;
  }

private:
  double draw(double most) {
    constexpr std::uint64_t grain = 1'000'000;
    return most * static_cast<double>(random_.below(grain)) / grain;
  }
  /// About normal: the sum of three.
  double noise(double sigma) { return sigma * 2 * (draw(1) + draw(1) + draw(1) - 1.5); }

  vm::Body body_;
  Duration between_;
  double lost_;
  vm::Sample first_;
  Duration now_{};
  Duration next_{};
  int orders_ = 0;
  Random random_{7};
};

/// The model's numbers, each so many times what they are.
spec::Driving changed(spec::Robot robot, const std::array<double, driving_rows.size()>& times) {
  const auto model = spec::driving(robot);
  auto numbers = model;
  for (std::size_t row = 0; row < driving_rows.size(); ++row)
    set_value(numbers, driving_rows[row], value_of(model, driving_rows[row]) * times[row]);
  return numbers;
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

/// Each number is found within 5 %, and a square that was driven by them ends four times nearer.
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
  constexpr double tiny_cm = 0.5; // what is right already cannot become better
  EXPECT_LT(after, std::max(tiny_cm, before / 4)) << all;
  fmt::print("{}; square {:.1f} cm, {:.1f} cm\n", all, before, after);
}

TEST(Calibrate, FindsHiddenNumbersInStreamsWithNoiseAndLosses) {
  for (const auto robot : {spec::Robot::Sphero, spec::Robot::Mini})
    for (const auto& times : changes) {
      const auto hidden = changed(robot, times);
      Hidden far(hidden, robot == spec::Robot::Mini ? 60ms : 30ms);
      const auto legs = drive_course(far, robot, {});
      ASSERT_TRUE(legs.has_value()) << legs.error().message;
      EXPECT_TRUE(far.braked);
      const auto found = fit(*legs, robot);
      ASSERT_TRUE(found.has_value()) << found.error().message;
      expect_found(hidden, *found);
    }
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

TEST(Calibrate, RefusesWhatADriveDoesNotTell) {
  const auto refusal = [](Hidden& far, spec::Robot robot) {
    const auto legs = drive_course(far, robot, {});
    if (!legs)
      return legs.error().message;
    const auto found = fit(*legs, robot);
    return found ? std::string("found") : found.error().message;
  };
  Hidden silent(spec::driving(spec::Robot::Sphero), 30ms, 0.95);
  EXPECT_EQ(
      refusal(silent, spec::Robot::Sphero),
      "only 0 of 24 legs are usable; the link lost the others; move closer to the robot and try "
      "again");
  Hidden still(spec::driving(spec::Robot::Sphero));
  still.held_fast = true;
  EXPECT_NE(refusal(still, spec::Robot::Sphero).find("nothing is holding it back"),
            std::string::npos);
  Hidden another(spec::driving(spec::Robot::Ollie));
  EXPECT_NE(refusal(another, spec::Robot::Sphero).find("the robot left the 2 m x 2 m"),
            std::string::npos);
  EXPECT_NE(refusal(another, spec::Robot::Ollie).find("cannot be measured"), std::string::npos);
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
