#include "base/random.h"
#include "compiler/load.h"
#include "vm/ball.h"
#include "vm/room/contacts.h"
#include "vm/room/room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <fmt/format.h>

namespace orb::vm {
namespace {

using spec::ball::radius;

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.next() >> 11) * 0x1p-53;
}

TEST(Neighbours, AreThoseThatEveryPairComparedWouldFind) {
  Random random{7};
  for (int round = 0; round < 300; ++round) {
    std::vector<Point> places;
    const double span = between(random, 1, 400);
    for (auto left = random.next() % 60; left > 0; --left)
      places.push_back({between(random, -span, span), between(random, -span, span)});
    const double distance = between(random, 0.1, 60);
    std::vector<IndexPair> wanted;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = i + 1; j < places.size(); ++j)
        if (std::hypot(places[i].x - places[j].x, places[i].y - places[j].y) <= distance)
          wanted.push_back({i, j});
    EXPECT_EQ(neighbours(places, distance), wanted) << "round " << round;
  }
}

struct Sums {
  double x = 0;
  double y = 0;
  double energy = 0;
};

Sums sums(const std::vector<Mover>& balls) {
  Sums sum;
  for (const auto& [place, velocity] : balls) {
    sum.x += velocity.x;
    sum.y += velocity.y;
    sum.energy += velocity.x * velocity.x + velocity.y * velocity.y;
  }
  return sum;
}

TEST(Contacts, KeepMomentumAndMakeNoEnergy) {
  Random random{11};
  std::size_t knocks = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Mover> balls;
    std::vector<Point> places;
    for (auto left = 2 + random.next() % 12; left > 0; --left) {
      balls.push_back({{between(random, 0, 20), between(random, 0, 20)},
                       {between(random, -200, 200), between(random, -200, 200)}});
      places.push_back(balls.back().place);
    }
    const auto before = sums(balls);
    const auto shoves = contacts(balls, neighbours(places, 2 * radius));
    Point shifted;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      balls[i].velocity.x += shoves[i].change.x;
      balls[i].velocity.y += shoves[i].change.y;
      shifted.x += shoves[i].shift.x;
      shifted.y += shoves[i].shift.y;
      knocks += shoves[i].knocks.size();
    }
    const auto after = sums(balls);
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);
    EXPECT_LE(after.energy, before.energy + 1e-9);
    EXPECT_NEAR(shifted.x, 0, 1e-9) << "what is between them stays where it was";
    EXPECT_NEAR(shifted.y, 0, 1e-9);
  }
  EXPECT_GT(knocks, 1000U);
}

TEST(Contacts, TwoThatMeetHeadOnGiveBackTheirShare) {
  const std::vector<Mover> balls{{{0, 0}, {100, 0}}, {{2 * radius - 0.1, 0}, {-100, 0}}};
  const auto shoves = contacts(balls, std::vector<IndexPair>{{0, 1}});
  EXPECT_NEAR(balls[0].velocity.x + shoves[0].change.x, -100 * spec::ball::ball_restitution, 1e-9);
  ASSERT_EQ(shoves[0].knocks.size(), 1U);
  EXPECT_NEAR(shoves[0].knocks[0].into.x, 100, 1e-9) << "as a wall at the same speed";
  EXPECT_EQ(shoves[0].knocks[0].other, 1U);
  EXPECT_NEAR(shoves[1].knocks[0].into.x, -100, 1e-9);
}

/// A ball of a room that records all its events as one text.
class Guest final : public Resident, public Observer {
public:
  Guest(const Placement& start, std::uint64_t seed, std::string_view program)
      : ball_(options(start, seed)) {
    ball_.connect();
    ball_.append_basic(Area::Ram, as_bytes(program));
    ball_.execute_basic(Area::Ram, 10);
  }
  void advance_to(Duration t) override {
    if (!takes_short_cuts || !ball_.coast(Instant{} + t))
      ball_.advance_to(Instant{} + t, Ball::Halt::Pass);
  }
  Mover mover() const override { return ball_.body().mover(); }
  Outlook outlook() const override {
    return {ball_.body().place(), ball_.body().most_speed_cm_s(),
            ball_.next_push() == never ? Duration::max() : ball_.next_push().time_since_epoch()};
  }
  void meet(const Shove& shove, std::span<const std::string> names) override {
    ball_.meet(shove, names);
  }
  void on_event(Instant at, const Event& event) override {
    text += fmt::format("{} {}", at.time_since_epoch().count(), event.index());
    if (const auto* position = std::get_if<event::Position>(&event))
      text += fmt::format(" {:a} {:a}", position->pose.x_cm, position->pose.y_cm);
    if (const auto* bump = std::get_if<event::Bump>(&event))
      text += fmt::format(" {} {}", bump->ball, bump->speed);
    text += '\n';
  }
  Ball& ball() { return ball_; }

  std::string text;
  bool takes_short_cuts = true;

private:
  BallOptions options(const Placement& start, std::uint64_t seed) {
    BallOptions made;
    made.start = start;
    made.seed = seed;
    made.loader = compiler::load;
    made.observer = this;
    return made;
  }
  Ball ball_;
};

/// Drives anywhere, with pauses, sometimes waits until it is moved, and sometimes gives way.
constexpr std::string_view restless = "10 basflg 1\n"
                                      "20 goroll rnd 360 - 1,rnd 200,rnd 2\n"
                                      "30 delay 50 + rnd 900\n"
                                      "40 if rnd 4 > 1 then goto 20\n"
                                      "50 goroll 0,0,0\n"
                                      "60 delay rnd 2000\n"
                                      "70 if rnd 5 > 1 then goto 20\n"
                                      "80 raw 1,rnd 255,1,rnd 255\n"
                                      "90 delay 300\n"
                                      "100 ctrl = 1\n"
                                      "110 goto 20\n";

struct Crowd {
  explicit Crowd(std::uint64_t seed, int count = 12) {
    Random random{seed};
    for (int i = 0; i < count; ++i) {
      const Placement start{{20.0 * (i % 4), 20.0 * (i / 4)}, between(random, 0, 360)};
      auto& guest = guests.emplace_back(start, random.next(), restless);
      for (const auto& wall : {Wall{Wall::Axis::X, -30}, Wall{Wall::Axis::X, 90}})
        guest.ball().apply(wall);
      for (const auto& wall : {Wall::between({-40, -30}, {100, -30}), Wall{Wall::Axis::Y, 90}})
        guest.ball().apply(wall);
      room.add(fmt::format("ball{:03}", i), guest);
    }
  }
  std::string story() const {
    std::string all;
    for (const auto& guest : guests)
      all += guest.text;
    return all;
  }
  std::deque<Guest> guests;
  Room room;
};

TEST(TheRoom, HowFarItGoesAtOnceChangesNothing) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Crowd at_once(seed);
    at_once.room.advance_to(20s);
    Crowd step_by_step(seed);
    while (step_by_step.room.now() < 20s)
      step_by_step.room.advance_to(step_by_step.room.now() + Body::step);
    EXPECT_EQ(at_once.story(), step_by_step.story()) << "seed " << seed;
    Crowd in_odd_pieces(seed);
    while (in_odd_pieces.room.now() < 20s)
      in_odd_pieces.room.advance_to(std::min<Duration>(20s, in_odd_pieces.room.now() + 37123us));
    EXPECT_EQ(at_once.story(), in_odd_pieces.story()) << "seed " << seed;
    Crowd the_long_way(seed);
    for (auto& guest : the_long_way.guests)
      guest.takes_short_cuts = false;
    the_long_way.room.advance_to(20s);
    EXPECT_EQ(at_once.story(), the_long_way.story()) << "seed " << seed;
    EXPECT_NE(at_once.story().find("ball00"), std::string::npos) << "they hit one another";
  }
}

TEST(TheRoom, NoBallIsInsideAnotherOrBehindAWall) {
  Crowd crowd(3);
  double deepest = 0;
  for (Duration t{}; t < 20s; t += 10ms) {
    crowd.room.advance_to(t);
    for (std::size_t i = 0; i < crowd.guests.size(); ++i) {
      const auto one = crowd.guests[i].mover().place;
      EXPECT_TRUE(one.x > -28 && one.x < 88 && one.y > -28 && one.y < 88);
      for (std::size_t j = 0; j < i; ++j) {
        const auto other = crowd.guests[j].mover().place;
        deepest = std::max(deepest, 2 * radius - std::hypot(one.x - other.x, one.y - other.y));
      }
    }
  }
  EXPECT_LT(deepest, 1.0); // cm: a crowd against a wall compresses slightly
}

TEST(TheRoom, ABallThatTouchesNothingLivesAsItDoesAlone) {
  Crowd crowd(5);
  const Placement apart{{5000, 5000}, 30};
  Guest far(apart, 99, restless);
  crowd.room.add("far", far);
  crowd.room.advance_to(30s);
  Guest alone(apart, 99, restless);
  alone.advance_to(30s);
  EXPECT_EQ(far.text, alone.text);
}

TEST(TheRoom, ABallThatIsHitRollsOffAndTheOtherGoesOn) {
  Guest stays({{0, 60}, 0}, 1, "10 delay 5000\n");
  Guest drives({}, 1, "10 goroll 0,60,1\n20 delay 3000\n30 goroll 0,0,0\n");
  Room room;
  room.add("drives", drives);
  room.add("stays", stays);
  room.advance_to(6s);
  EXPECT_NE(stays.text.find(" drives 0\n"), std::string::npos) << "it stood: speed 0";
  EXPECT_NE(drives.text.find(" stays "), std::string::npos);
  EXPECT_GT(stays.mover().place.y, 61);
  EXPECT_GE(stays.mover().place.y - drives.mover().place.y, 2 * radius - 1e-6);
  EXPECT_GT(drives.mover().place.y, 60) << "it pushes the other one on";
}

TEST(ABallThatIsPlaced, HasItsOwnAxes) {
  Guest ball({{100, 50}, 90}, 1, "10 goroll 0,60,1\n20 delay 3000\n");
  ball.advance_to(3s);
  EXPECT_NEAR(ball.ball().body().pose().x_cm, 0, 1e-9);
  EXPECT_GT(ball.ball().body().pose().y_cm, 100) << "ahead, as it sees it";
  EXPECT_EQ(ball.ball().body().pose().heading_deg, 0);
  EXPECT_GT(ball.ball().body().world_pose().x_cm, 200) << "to the right, as the room sees it";
  EXPECT_NEAR(ball.ball().body().world_pose().y_cm, 50, 1e-9);
  EXPECT_EQ(ball.ball().body().world_pose().heading_deg, 90);
}

} // namespace
} // namespace orb::vm
