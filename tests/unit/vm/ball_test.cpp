#include "base/random.h"
#include "compiler/load.h"
#include "protocol/decoder.h"
#include "vm/ball.h"
#include "vm/rules.h"

#include <gtest/gtest.h>

namespace orb::vm {
namespace {

/// Records events.
class Notebook final : public Observer {
public:
  void on_event(Instant at, const Event& event) override { events.push_back({at, event}); }
  template <class Kind>
  std::vector<Kind> all() const {
    std::vector<Kind> found;
    for (const auto& [at, event] : events)
      if (const auto* one = std::get_if<Kind>(&event))
        found.push_back(*one);
    return found;
  }
  std::vector<std::pair<Instant, Event>> events;
};

class TheBall : public ::testing::Test {
protected:
  TheBall() : ball(options()) { ball.connect(); }

  BallOptions options() {
    BallOptions made;
    made.loader = compiler::load;
    made.observer = &notebook;
    return made;
  }
  void run(std::string_view text, Duration time, int line = 10) {
    ball.append_basic(Area::Ram, as_bytes(text));
    ASSERT_EQ(ball.execute_basic(Area::Ram, line), Outcome::Done);
    ball.advance_to(ball.now() + time);
  }
  void abort() {
    ball.receive(encode(protocol::make_command(spec::ApiCommand::AbortOrbbasicProgram)));
  }
  std::vector<protocol::Async> messages() {
    std::vector<protocol::Async> found;
    const Bytes bytes = ball.take_output();
    protocol::Decoder decoder(protocol::Direction::FromBall);
    decoder.feed(bytes);
    while (const auto item = decoder.next())
      if (item->kind == protocol::Item::Kind::Async)
        found.push_back(item->async());
    return found;
  }

  Notebook notebook;
  Ball ball;
};

TEST_F(TheBall, RollsAsClientsExpect) {
  ball.drive(Roll{0, 120, Go::Drive});
  ball.advance_to(ball.now() + 900ms);
  EXPECT_GT(ball.body().pose().y_cm, 5);
  EXPECT_NEAR(ball.body().pose().x_cm, 0, 1e-9);
  ball.drive(Roll{0, 0, Go::Brake});
  ball.advance_to(ball.now() + 3s);
  EXPECT_TRUE(ball.body().stopped());
  EXPECT_EQ(ball.body().next_step(), never) << "a ball at rest costs nothing";
}

TEST_F(TheBall, Heading90IsToTheRight) {
  ball.drive(Roll{90, 0, Go::Drive});
  ball.advance_to(ball.now() + 1s);
  EXPECT_DOUBLE_EQ(ball.body().yaw_deg(), 90);
  ball.drive(Roll{90, 255, Go::Drive});
  ball.advance_to(ball.now() + 4s);
  EXPECT_GT(ball.body().pose().x_cm, 300);
  EXPECT_EQ(ball.body().speed(), 255);
  EXPECT_NEAR(ball.body().pose().speed_cm_s, 200, 1e-6);
}

TEST_F(TheBall, TurnsAtTheRotationRateWhileItDrives) {
  const double rate = spec::ball::default_rotation_rate * spec::ball::turn_gain;
  ball.drive(Roll{0, 255, Go::Drive});
  ball.advance_to(ball.now() + 3s);
  ball.drive(Roll{90, 255, Go::Drive});
  ball.advance_to(ball.now() + spec::ball::dead_time + 250ms);
  EXPECT_NEAR(ball.body().yaw_deg(), rate * 0.25, 1);
  ball.drive(Roll{180, 255, Go::FastTurn});
  ball.advance_to(ball.now() + spec::ball::dead_time);
  EXPECT_NEAR(ball.body().yaw_deg(), rate * 0.35, 1) << "on its way, the order changes nothing";
  ball.advance_to(ball.now() + 50ms);
  EXPECT_NEAR(ball.body().yaw_deg(), rate * 0.35 + 50, 3);
}

TEST_F(TheBall, AnOrderReachesTheMotorsAfterTheDeadTime) {
  ball.drive(Roll{0, 60, Go::Drive});
  EXPECT_EQ(ball.body().speed_setpoint(), 60);
  ball.advance_to(ball.now() + spec::ball::dead_time);
  EXPECT_EQ(ball.body().pose().speed_cm_s, 0);
  ball.advance_to(ball.now() + 10ms);
  EXPECT_GT(ball.body().pose().speed_cm_s, 0);
}

TEST_F(TheBall, OrdersArriveInTheirOrder) {
  for (int heading = 0; heading < 200; ++heading) {
    ball.drive(Roll{heading, 60, Go::Drive});
    ball.advance_to(ball.now() + 1ms);
  }
  ball.drive(Roll{90, 0, Go::Brake});
  ball.advance_to(ball.now() + 50ms);
  EXPECT_GT(ball.body().pose().speed_cm_s, 5) << "the stop is still on its way";
  ball.advance_to(ball.now() + 1s);
  EXPECT_TRUE(ball.body().stopped());
  EXPECT_DOUBLE_EQ(ball.body().yaw_deg(), 90);
}

TEST_F(TheBall, ARotationOutdatesTheHeadingsOnTheirWayAndNotTheSpeeds) {
  ball.drive(Roll{180, 40, Go::Drive});
  ball.drive(Rotate{90, 200ms});
  ball.advance_to(ball.now() + 3s);
  EXPECT_DOUBLE_EQ(ball.body().yaw_deg(), 90);
  EXPECT_NEAR(ball.body().pose().speed_cm_s, spec::speed_cm_s({}, 40), 1e-9);
}

TEST_F(TheBall, StabilisationOffForgetsWhatIsOnItsWay) {
  ball.drive(Roll{0, 100, Go::Drive});
  ball.drive(Stabilization::Off);
  ball.advance_to(ball.now() + 1s);
  EXPECT_EQ(ball.body().pose().speed_cm_s, 0);
  EXPECT_EQ(ball.body().next_step(), never);
}

TEST_F(TheBall, DrivesAsFastAsTheRecordedDrives) {
  for (const auto& [ordered, cm_s] : {std::pair{25, 34.1}, {45, 52.4}, {65, 70.7}}) {
    ball.drive(Roll{0, ordered, Go::Drive});
    ball.advance_to(ball.now() + 3s);
    EXPECT_NEAR(ball.body().pose().speed_cm_s, cm_s, 0.1) << ordered;
  }
}

TEST_F(TheBall, ATurnWhileItDrivesIsABend) {
  ball.drive(Roll{0, 60, Go::Drive});
  ball.advance_to(ball.now() + 3s);
  const auto before = ball.body().pose();
  ball.drive(Roll{90, 60, Go::Drive});
  double slowest = before.speed_cm_s;
  for (int i = 0; i < 100; ++i) {
    ball.advance_to(ball.now() + 10ms);
    slowest = std::min(slowest, ball.body().pose().speed_cm_s);
  }
  EXPECT_LT(slowest, before.speed_cm_s * 0.9) << "a turn costs speed";
  EXPECT_GT(slowest, before.speed_cm_s * 0.4);
  EXPECT_GT(ball.body().pose().y_cm, before.y_cm + 10) << "it goes on the old way for a while";
  EXPECT_NEAR(ball.body().velocity_cm_s().y, 0, 1);
}

TEST_F(TheBall, SetHeadingKeepsTheLocatorsAxes) {
  ball.drive(Roll{90, 0, Go::Drive});
  ball.advance_to(ball.now() + 1s);
  ball.drive(SetHeading{0});
  EXPECT_DOUBLE_EQ(ball.body().yaw_deg(), 0);
  ball.drive(Roll{0, 200, Go::Drive});
  ball.advance_to(ball.now() + 1s);
  EXPECT_GT(ball.body().pose().x_cm, 20) << "still driving along the old 90 degrees";
  EXPECT_NEAR(ball.body().pose().y_cm, 0, 1e-6);
}

TEST_F(TheBall, AWallStopsItAndIsACollision) {
  ball.apply(Wall{Wall::Axis::Y, 50});
  Settings settings = ball.settings();
  settings.collisions = {1, 0, 0, 50, 0, 100};
  ball.change(settings);
  ball.drive(Roll{0, 200, Go::Drive});
  ball.advance_to(ball.now() + 5s);
  EXPECT_LT(ball.body().pose().y_cm, 50);
  const auto collisions = notebook.all<event::Collision>();
  ASSERT_FALSE(collisions.empty());
  EXPECT_EQ(collisions[0].axis, 2);
  EXPECT_GT(collisions[0].y, 0) << "the front was hit";
  bool told = false;
  for (const auto& message : messages())
    told |= message.id == static_cast<std::uint8_t>(spec::AsyncId::Collision) &&
            message.data.size() == 16;
  EXPECT_TRUE(told);
}

TEST_F(TheBall, AWallBetweenTwoPointsStopsItLikeAnEndlessOne) {
  const auto drive = [&](const Wall& wall) {
    Ball one(options());
    one.connect();
    one.apply(wall);
    one.drive(Roll{20, 200, Go::Drive});
    std::vector<Pose> way;
    for (int i = 0; i < 100; ++i) {
      one.advance_to(one.now() + 20ms);
      way.push_back(one.body().pose());
    }
    return way;
  };
  const auto endless = drive({Wall::Axis::Y, 50});
  const auto between = drive(Wall::between({-1000, 50}, {1000, 50}));
  for (std::size_t i = 0; i < endless.size(); ++i) {
    ASSERT_NEAR(endless[i].x_cm, between[i].x_cm, 1e-6) << i;
    ASSERT_NEAR(endless[i].y_cm, between[i].y_cm, 1e-6) << i;
  }
  EXPECT_LT(between.back().y_cm, 50);
  EXPECT_GT(between.back().x_cm, 10) << "it slides along the wall";
}

TEST_F(TheBall, PassesBesideTheEndOfAWall) {
  const double radius = spec::ball::radius;
  ball.apply(Wall::between({radius + 0.1, 30}, {50, 30}));
  ball.drive(Roll{0, 200, Go::Drive});
  ball.advance_to(ball.now() + 2s);
  EXPECT_GT(ball.body().pose().y_cm, 100);
  EXPECT_TRUE(notebook.all<event::Bump>().empty());
}

TEST_F(TheBall, HitsTheEndOfAWallAndIsTurnedAside) {
  const auto wall = Wall::between({1, 30}, {50, 30});
  ball.apply(wall);
  ball.drive(Roll{0, 100, Go::Drive});
  ball.advance_to(ball.now() + 5s);
  const auto bumps = notebook.all<event::Bump>();
  ASSERT_FALSE(bumps.empty());
  EXPECT_EQ(bumps[0].wall, wall);
  EXPECT_EQ(to_string(bumps[0].wall), "1,30 to 50,30");
  EXPECT_LT(ball.body().pose().x_cm, 0) << "past the end, to the left of it";
}

TEST_F(TheBall, NeverLeavesARoomOfWalls) {
  // A triangle with narrow corners, and pushes as hard as a script allows.
  const Point corners[] = {{-80, -30}, {80, -30}, {0, 60}};
  for (int i = 0; i < 3; ++i)
    ball.apply(Wall::between(corners[i], corners[(i + 1) % 3]));
  Random random{7};
  for (int i = 0; i < 400; ++i) {
    const auto heading = static_cast<int>(random.next() % 360);
    ball.apply(stimulus::Push{heading, 255});
    if (i % 3 == 0)
      ball.apply(stimulus::Push{heading, 255});
    ball.drive(Roll{heading, 255, Go::FastTurn});
    ball.advance_to(ball.now() + 90ms);
    const auto pose = ball.body().pose();
    for (int side = 0; side < 3; ++side) {
      const auto from = corners[side], to = corners[(side + 1) % 3];
      const double inside =
          (to.x - from.x) * (pose.y_cm - from.y) - (pose.x_cm - from.x) * (to.y - from.y);
      ASSERT_GT(inside, 0) << i << ": " << pose.x_cm << "," << pose.y_cm;
    }
  }
}

TEST_F(TheBall, TellsThatItRanIntoAWallEvenUnasked) {
  const Wall wall{Wall::Axis::Y, 50};
  ball.apply(wall);
  ball.apply(stimulus::Push{0, 200});
  EXPECT_TRUE(notebook.all<event::Bump>().empty()) << "a push is not a wall";
  ball.advance_to(ball.now() + 1s);
  const auto bumps = notebook.all<event::Bump>();
  ASSERT_EQ(bumps.size(), 1u);
  EXPECT_EQ(bumps[0].wall, wall);
  EXPECT_GT(bumps[0].speed, 0);
  EXPECT_TRUE(notebook.all<event::Collision>().empty()) << "nobody asked for collisions";
}

TEST_F(TheBall, ReportsErrorsOnBothChannels) {
  run("10 A = 1\n20 print 1/0\n", 1s);
  const auto found = messages();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].id, static_cast<std::uint8_t>(spec::AsyncId::BasicErrorText));
  EXPECT_EQ(as_text(found[0].data), "Line 20: Divide by zero\n");
  EXPECT_EQ(found[1].id, static_cast<std::uint8_t>(spec::AsyncId::BasicError));
  EXPECT_EQ(found[1].data, (Bytes{0, 20, 0, 8}));
}

TEST_F(TheBall, AbortIsReported) {
  run("10 goto 10\n", 1s);
  abort();
  ball.advance_to(ball.now() + 1s);
  const auto found = messages();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(as_text(found[0].data), "Line 10: User abort\n");
}

TEST_F(TheBall, ANumberThatHasNoPlaceIsAnError) {
  run("10 input Z\n", 1s); // Y is 0
  ball.apply(stimulus::Number{5});
  ball.advance_to(ball.now() + 1s);
  const auto errors = notebook.all<event::Error>();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].code, spec::BasicError::IllegalIndex);
  EXPECT_EQ(notebook.all<event::End>().size(), 1u);
}

TEST_F(TheBall, AFullQueuePausesTheProgramAndLosesNothing) {
  run("10 A = A + 1\n20 print A\n30 goto 10\n", 1s);
  std::string text;
  std::size_t wire = 0;
  for (const auto& message : messages()) {
    wire += message.data.size() + 6;
    text += as_text(message.data);
  }
  EXPECT_LE(wire, 11520u);
  EXPECT_GT(wire, 9500u);
  std::string expected;
  for (int n = 1; expected.size() < text.size(); ++n)
    expected += std::to_string(n) + "\n";
  EXPECT_EQ(text, expected);
}

TEST_F(TheBall, WithoutAClientPrintsDoNotPause) {
  ball.disconnect();
  run("10 A = A + 1\n20 print A\n30 goto 10\n", 1s);
  EXPECT_EQ(ball.machine().lines(), 3000u);
}

TEST_F(TheBall, TheProgramsColourGoesBeforeTheClients) {
  ball.set_led({1, 2, 3});
  run("10 RGB 9,8,7\n20 delay 1000\n", 500ms);
  EXPECT_EQ(ball.led(), (Color{9, 8, 7}));
  ball.set_led({4, 5, 6});
  EXPECT_EQ(ball.led(), (Color{9, 8, 7}));
  ball.apply(stimulus::Battery{6.8});
  EXPECT_EQ(ball.led(), (Color{255, 0, 0})) << "the battery's warning goes before all";
  ball.apply(stimulus::Battery{7.8});
  ball.advance_to(ball.now() + 1s);
  EXPECT_EQ(ball.led(), (Color{4, 5, 6}));
}

TEST_F(TheBall, AnExclusiveProgramDrivesAlone) {
  run("10 basflg 1\n20 goroll 0,100,1\n30 delay 1000\n40 print cmdroll,hdgval,spdval\n", 500ms);
  ball.drive(Roll{180, 255, Go::Drive});
  ball.advance_to(ball.now() + 200ms);
  EXPECT_DOUBLE_EQ(ball.body().heading_setpoint_deg(), 0);
  ball.advance_to(ball.now() + 1s);
  const auto prints = notebook.all<event::Print>();
  ASSERT_EQ(prints.size(), 1u);
  EXPECT_EQ(prints[0].text, "1 180 255\n") << "the program sees what the client wanted";
  ball.drive(Roll{180, 255, Go::Drive});
  EXPECT_DOUBLE_EQ(ball.body().heading_setpoint_deg(), 180) << "the flag ended with the program";
}

TEST_F(TheBall, SleepsAfterInactivityUnlessAProgramRuns) {
  ball.advance_to(Instant{599s});
  EXPECT_FALSE(ball.asleep());
  ball.advance_to(Instant{601s});
  EXPECT_TRUE(ball.asleep());
  ball.connect();
  EXPECT_FALSE(ball.asleep());
  run("10 goto 10\n", 700s);
  EXPECT_FALSE(ball.asleep());
  abort();
  run("", 0s, 10); // text and program are unchanged
  abort();
}

TEST_F(TheBall, WakesIntoFlash) {
  ball.append_basic(Area::Flash, as_bytes("100 print \"up\", isconn\n"));
  run("10 sleep 3,0,100\n20 print \"never\"\n", 2s);
  EXPECT_TRUE(ball.asleep());
  EXPECT_TRUE(ball.basic_text(Area::Ram).empty()) << "RAM is lost in sleep";
  ball.advance_to(ball.now() + 2s);
  EXPECT_FALSE(ball.asleep());
  const auto prints = notebook.all<event::Print>();
  ASSERT_EQ(prints.size(), 1u);
  EXPECT_EQ(prints[0].text, "up 0\n");
}

TEST_F(TheBall, StopsOnDisconnectWhenAsked) {
  Settings settings = ball.settings();
  settings.temporary_flags = spec::temporary_option_flags::stop_on_disconnect;
  ball.change(settings);
  ball.drive(Roll{0, 200, Go::Drive});
  ball.advance_to(ball.now() + 1s);
  ball.disconnect();
  ball.advance_to(ball.now() + 2s);
  EXPECT_TRUE(ball.body().stopped());
  EXPECT_EQ(ball.settings().temporary_flags, 0u) << "once";
}

TEST_F(TheBall, MotionTimesOutWhenAsked) {
  Settings settings = ball.settings();
  settings.permanent_flags = spec::permanent_option_flags::motion_timeout;
  ball.change(settings);
  ball.drive(Roll{0, 100, Go::Drive});
  ball.advance_to(ball.now() + 5s);
  EXPECT_TRUE(ball.body().stopped());
}

TEST_F(TheBall, StoresWhatFits) {
  const std::string half(2048, 'x');
  EXPECT_EQ(ball.append_basic(Area::Ram, as_bytes(half)), Outcome::Done);
  EXPECT_EQ(ball.append_basic(Area::Ram, as_bytes(half + "y")), Outcome::Refused);
  EXPECT_EQ(ball.basic_text(Area::Ram).size(), 2048u) << "nothing of what did not fit";
  EXPECT_EQ(ball.append_basic(Area::Ram, as_bytes(std::string_view("10 end\n\0zzz", 11))),
            Outcome::Done);
  EXPECT_EQ(ball.basic_text(Area::Ram).size(), 2048u + 8) << "up to the final NUL";
  EXPECT_EQ(ball.erase_basic(Area::Ram), Outcome::Done);
  EXPECT_TRUE(ball.basic_text(Area::Ram).empty());
}

TEST(Stimulus, ScriptsAreReadLineByLine) {
  const Source source("s", "wall x=200\nat 1.5s shake # twice\n\nat 200ms push 90 120\nat 1min "
                           "battery 6.9\nat 2s jump\nat 5 shake\nat 1s tilt 1\nat 1s shake 1\n");
  const auto script = parse_stimulus(source);
  ASSERT_EQ(script.events.size(), 4u);
  EXPECT_EQ(script.events[1].at, Duration{200ms});
  EXPECT_EQ(script.events[3].at, Duration{60s});
  EXPECT_EQ(script.diagnostics.size(), 4u);
}

TEST(Stimulus, EveryRuleHasAnExampleThatRaisesIt) {
  for (const auto& rule : rules::all()) {
    const auto bad = parse_stimulus(Source("bad", std::string(rule.bad)));
    ASSERT_EQ(bad.diagnostics.size(), 1u) << rule.id;
    EXPECT_EQ(bad.diagnostics[0].rule->id, rule.id);
    EXPECT_TRUE(parse_stimulus(Source("good", std::string(rule.good))).diagnostics.empty());
  }
}

} // namespace
} // namespace orb::vm
