#include "debug/timeline.h"

#include "tests/random_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::debug {
namespace {

class Silence final : public Audience {
public:
  void on_event(Duration t, const vm::Event& event) override {
    if (const auto* print = std::get_if<vm::event::Print>(&event))
      printed += fmt::format("{}:{};", t.count(), print->text);
  }
  std::string printed;
};

/// Stops before every step.
class EveryStep final : public Watch {
public:
  bool line() override { return true; }
  bool command() override { return true; }
};

/// Stops when the ball has hit something, or has started to roll.
class EveryBump final : public Watch {
public:
  bool wants_lines() const override { return false; }
  bool event(const vm::Event& event) override {
    return std::holds_alternative<vm::event::Bump>(event) ||
           std::holds_alternative<vm::event::Drive>(event) ||
           std::holds_alternative<vm::event::Error>(event);
  }
};

class Nothing final : public Watch {
public:
  bool wants_lines() const override { return false; }
};

const GiveUp never_give_up = [] { return false; };

run::Input input_of(std::string name, std::string text) {
  structured::NoFiles files;
  auto input = run::read_input(std::move(name), std::move(text), "", {}, files);
  EXPECT_TRUE(input.has_value());
  return *std::move(input);
}

/// Everything that a user or the program can observe in a session.
std::string state(const Timeline& timeline) {
  const auto& ball = timeline.ball();
  const auto& machine = ball.machine();
  auto text = fmt::format(
      "{} {} {} line {} lines {} depth {} data {} wait {} led {:02x}{:02x}{:02x}",
      timeline.now().step, timeline.now().about_to, timeline.time().count(), machine.line(),
      machine.lines(), machine.core().frames.call_depth, machine.core().data_next, machine.waits(),
      ball.led().red, ball.led().green, ball.led().blue);
  for (std::size_t i = 0; i < bytecode::first_temporary; ++i)
    text += fmt::format(" {}", machine.variable(i));
  for (const auto& row : spec::variables)
    if (const auto found = spec::find_variable(row.word))
      text += fmt::format(" {}", timeline.sensor(*found));
  const auto pose = ball.body().world_pose();
  text += fmt::format(" at {},{} {} {}", pose.x_cm, pose.y_cm, pose.heading_deg, pose.speed_cm_s);
  for (const auto& place : ball.macros().places())
    text += fmt::format(" macro {}:{}", place.id, place.command);
  return text;
}

constexpr auto macros =
    ".macro wink id=40\nrgb 255 0 0 delay=20\nroll 90 90 delay=50\nrgb 0 0 255\n"
    "delay 7\nrgb 0 255 0\nroll 0 90\n";

struct Session {
  std::vector<run::Input> inputs;
  run::Options options;
  Silence silence;
  std::unique_ptr<Timeline> timeline;

  explicit Session(const std::string& program) {
    inputs.push_back(input_of("wink.macro", macros));
    inputs.push_back(input_of("p.bas", program));
    const std::string world = "wall x=8\nat 50ms push 90 100\nat 120ms shake\n";
    options.stimuli = vm::parse_stimulus(Source("s", world)).events;
    options.numbers = {3, 4, 5};
    auto started = Timeline::start(inputs, options, silence, nullptr);
    if (started)
      timeline = *std::move(started);
  }
};

} // namespace

TEST(Timeline, StandsBeforeTheFirstLineAtTheStart) {
  Session session("10 A = 1\n20 B = A + 1\n30 delay 1000\n40 print B\n");
  auto& timeline = *session.timeline;
  EXPECT_EQ(timeline.ball().machine().line(), 10);
  EXPECT_EQ(timeline.time(), 0s);
  EveryStep every;
  EXPECT_EQ(timeline.forward(every, Duration::max(), never_give_up), Halt::Found);
  EXPECT_EQ(timeline.forward(every, Duration::max(), never_give_up), Halt::Found);
  EXPECT_EQ(timeline.ball().machine().line(), 30);
  EXPECT_EQ(timeline.ball().machine().variable(1), 2);
  Nothing nothing;
  EXPECT_EQ(timeline.forward(nothing, 500ms, never_give_up), Halt::Time);
  EXPECT_EQ(timeline.time(), 500ms);
  EXPECT_EQ(timeline.ball().machine().line(), 30); // it waits
  EXPECT_EQ(timeline.forward(every, Duration::max(), never_give_up), Halt::Found);
  EXPECT_EQ(timeline.ball().machine().line(), 40);
  EXPECT_EQ(timeline.time(), 1001ms);
  EXPECT_EQ(timeline.forward(every, Duration::max(), never_give_up), Halt::Over);
  EXPECT_EQ(timeline.back(every, never_give_up), Halt::Found);
  EXPECT_EQ(timeline.ball().machine().line(), 40);
  EXPECT_EQ(timeline.back(every, never_give_up), Halt::Found);
  EXPECT_EQ(timeline.ball().machine().line(), 30);
}

TEST(Timeline, AnEndlessProgramRunsUntilItIsGivenUp) {
  Session session("10 A = A + 1\n20 goto 10\n");
  int asked = 0;
  const GiveUp later = [&] { return ++asked > 20; };
  Nothing nothing;
  EXPECT_EQ(session.timeline->forward(nothing, Duration::max(), later), Halt::GivenUp);
  EXPECT_TRUE(session.timeline->now().about_to);
  EveryStep every;
  asked = 0;
  class Never final : public Watch {
  } unfound;
  EXPECT_EQ(session.timeline->forward(unfound, Duration::max(), later), Halt::GivenUp);
}

TEST(Timeline, WhatWasChangedHappensAgain) {
  Session session("10 A = 1\n20 B = A + 1\n30 print B\n40 goto 10\n");
  auto& timeline = *session.timeline;
  EveryStep every;
  timeline.forward(every, Duration::max(), never_give_up);
  EXPECT_TRUE(timeline.change(SetVariable{0, 41}));
  timeline.forward(every, Duration::max(), never_give_up);
  EXPECT_EQ(timeline.ball().machine().variable(1), 42);
  const auto there = state(timeline);
  const auto moment = timeline.now();
  timeline.back(every, never_give_up);
  timeline.back(every, never_give_up);
  EXPECT_EQ(timeline.ball().machine().variable(0), 0);
  timeline.go_to(moment);
  EXPECT_EQ(state(timeline), there);
  EXPECT_TRUE(timeline.change(GoToLine{10}));
  EXPECT_FALSE(timeline.change(GoToLine{11}));
  EXPECT_EQ(timeline.ball().machine().line(), 10);
}

/// n steps forward and n back lead to the same state, for random programs and n; the state does not
/// depend on the way there.
RC_GTEST_PROP(Timeline, BackIsWhereItWas, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
  testing::RandomProgram writer(seed, {.lines = 30, .wild_jump = 0.0, .comments = 0.0});
  auto text = "1 macrun 40\n2 goroll " + std::to_string(seed % 360) + ",200,1\n" + writer.write();
  Session session(text +
                  "9000 delay 300\n9010 gosub 9030\n9020 end\n9030 A = A + 1\n9040 return\n");
  if (session.timeline == nullptr)
    return;
  auto& timeline = *session.timeline;
  Random random{seed};
  EveryStep every;
  EveryBump bump;
  Nothing nothing;
  std::vector<Moment> moments{timeline.now()};
  std::vector<std::string> states{state(timeline)};
  const auto steps = 1 + random.below(300);
  for (std::uint64_t i = 0; i < steps; ++i) {
    const auto way = random.below(40);
    const auto halt = way == 0   ? timeline.forward(bump, timeline.time() + 1s, never_give_up)
                      : way == 1 ? timeline.forward(nothing, timeline.time() + 13ms, never_give_up)
                                 : timeline.forward(every, Duration::max(), never_give_up);
    if (halt == Halt::Over)
      break;
    if (timeline.now() == moments.back())
      continue;
    RC_ASSERT(moments.back() < timeline.now());
    moments.push_back(timeline.now());
    states.push_back(state(timeline));
  }
  const auto printed = session.silence.printed;
  for (int i = 0; i < 20; ++i) {
    const auto there = random.below(moments.size());
    timeline.go_to(moments[there]);
    RC_ASSERT(state(timeline) == states[there]);
  }
  // Goes back to the beginning step by step, then forward to the same place.
  timeline.go_to(moments.back());
  std::size_t at = moments.size() - 1;
  for (int i = 0; i < 300 && timeline.back(every, never_give_up) == Halt::Found; ++i) {
    while (at > 0 && timeline.now() < moments[at])
      --at;
    if (timeline.now() == moments[at])
      RC_ASSERT(state(timeline) == states[at]);
  }
  timeline.go_to(moments.back());
  RC_ASSERT(state(timeline) == states.back());
  RC_ASSERT(session.silence.printed == printed);
}

/// Searching backwards finds the same places as forwards.
RC_GTEST_PROP(Timeline, FindsTheSamePlacesBackwards, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
  testing::RandomProgram writer(seed, {.lines = 12, .wild_jump = 0.0, .comments = 0.0});
  Session session("1 macrun 40\n2 goroll 90,200,1\n3 delay 100\n" + writer.write());
  if (session.timeline == nullptr)
    return;
  auto& timeline = *session.timeline;
  EveryBump bump;
  std::vector<Moment> found;
  while (found.size() < 40 &&
         timeline.forward(bump, timeline.time() + 2s, never_give_up) == Halt::Found)
    if (found.empty() || !(found.back() == timeline.now()))
      found.push_back(timeline.now());
  while (!found.empty() && !(found.back() < timeline.now()))
    found.pop_back();
  while (!found.empty()) {
    RC_ASSERT(timeline.back(bump, never_give_up) == Halt::Found);
    RC_ASSERT(timeline.now() == found.back());
    found.pop_back();
  }
}

} // namespace orb::debug
