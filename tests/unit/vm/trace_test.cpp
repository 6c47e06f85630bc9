#include "compiler/load.h"
#include "lively.h"
#include "vm/ball.h"

#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace orb::vm {
namespace {

/// FNV-1a over all events, with numbers exact to the last bit.
class TraceHash final : public Observer {
public:
  void on_event(Instant at, const Event& event) override {
    mix(static_cast<std::uint64_t>(at.time_since_epoch().count()));
    mix(event.index());
    std::visit([&](const auto& one) { take(one); }, event);
    ++events;
  }
  std::uint64_t hash = 14695981039346656037u;
  std::uint64_t events = 0;

private:
  void mix(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (value >> byte * 8 & 0xFF)) * 1099511628211u;
    }
  }
  void mix_real(double value) {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof bits);
    mix(bits);
  }
  void mix_int(int value) { mix(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  void take(const event::StopLost&) {} // only of remote robots
  void take(const event::Matrix&) {}   // only of a BOLT
  void take(const event::Print& x) {
    for (const char c : x.text)
      mix(static_cast<unsigned char>(c));
  }
  void take(const event::Error& x) {
    mix_int(x.line);
    mix(spec::code(x.code));
  }
  void take(const event::Led& x) { mix_int(x.color.red << 16 | x.color.green << 8 | x.color.blue); }
  void take(const event::BackLed& x) { mix_int(x.value); }
  void take(const event::Drive& x) {
    mix_int(x.roll.heading_deg);
    mix_int(x.roll.speed);
  }
  void take(const event::Position& x) {
    mix_real(x.pose.x_cm);
    mix_real(x.pose.y_cm);
    mix_real(x.pose.heading_deg);
    mix_real(x.pose.speed_cm_s);
  }
  void take(const event::Marker& x) { mix_int(x.marker); }
  void take(const event::Macro& x) { mix_int(x.command); }
  void take(const event::Line& x) { mix_int(x.line); }
  void take(const event::Collision& x) {
    mix_int(x.x);
    mix_int(x.y);
  }
  void take(const event::Sleep& x) { mix_int(x.seconds); }
  void take(const event::End& x) { mix(x.lines); }
  void take(const event::MacroEnd& x) { mix_int(x.command); }
  void take(const event::Bump& x) {
    mix_real(x.wall.at_cm);
    mix_int(x.speed);
  }
};

TraceHash trace(std::string_view text, Duration time, std::uint64_t seed, Dispatch dispatch,
                Duration piece = 1s) {
  TraceHash hash;
  BallOptions options;
  options.seed = seed;
  options.loader = compiler::load;
  options.observer = &hash;
  options.dispatch = dispatch;
  Ball ball(options);
  ball.connect();
  ball.apply(Wall{Wall::Axis::X, 60});
  ball.apply(Wall{Wall::Axis::Y, -45});
  ball.apply(stimulus::Noise{Switch::On});
  Settings settings = ball.settings();
  settings.collisions = {1, 20, 20, 20, 20, 10};
  ball.change(settings);
  ball.append_basic(Area::Ram, as_bytes(text));
  ball.execute_basic(Area::Ram, 10);
  for (Instant at = ball.now(); at < Instant{time}; at += piece) {
    ball.advance_to(at + piece);
    ball.take_output();
  }
  return hash;
}

std::string shown(const TraceHash& trace) {
  return fmt::format("{:016x} {}", trace.hash, trace.events);
}

// Every compiler and optimisation level must give the same result: ./dev fuzz builds them all.
TEST(Trace, IsTheSameEverywhere) {
  EXPECT_EQ(shown(trace(lively, 60s, 1, Dispatch::Threaded)), "68aad7bb7e7fd56f 4150");
  EXPECT_EQ(shown(trace(lively, 60s, 2, Dispatch::Switch)), "21838d3c45237fdf 4126");
}

TEST(Trace, DoesNotDependOnHowTimeIsCut) {
  const auto whole = shown(trace(lively, 8s, 7, Dispatch::Threaded));
  EXPECT_EQ(shown(trace(lively, 8s, 7, Dispatch::Threaded, 1ms)), whole);
  EXPECT_EQ(shown(trace(lively, 8s, 7, Dispatch::Switch, 160ms)), whole);
}

/// Observes every step and ignores it.
class Watching final : public StepObserver {
public:
  void on_step(Instant, const Body&) override {}
};

/// Records the place at every event.
class Places final : public Observer {
public:
  void on_event(Instant at, const Event& event) override {
    const auto pose = ball->body().world_pose();
    text += fmt::format("{} {} {:a} {:a} {:a}\n", at.time_since_epoch().count(), event.index(),
                        pose.x_cm, pose.y_cm, ball->body().way_cm());
  }
  std::string text;
  const Ball* ball = nullptr;
};

/// A freely rolling ball is advanced late, but not while its steps are observed.
TEST(Trace, IsTheSameHoweverLateTheBodyComes) {
  constexpr std::string_view program = "10 goroll A,1 + (A & 64),1\n"
                                       "20 for T = 1 to 40\n"
                                       "30 RGB T,T,T\n" // writes, but reads nothing
                                       "40 next T\n"
                                       "50 if A % 20 = 0 then ctrl = 0 else B = B + 1\n"
                                       "60 for T = 1 to 60\n" // a slow ball stops meanwhile
                                       "70 next T\n"
                                       "80 print xpos,ypos,Sbatt\n"
                                       "90 delay 90\n"
                                       "100 ctrl = 1\n"
                                       "110 A = A + 10 & 127\n"
                                       "120 goto 10\n";
  const auto run = [&](double volts_to_low, StepObserver* steps) {
    Places places;
    BallOptions options;
    options.loader = compiler::load;
    options.observer = &places;
    options.steps = steps;
    Ball ball(options);
    places.ball = &ball;
    ball.connect();
    ball.apply(stimulus::Battery{ball.settings().low_battery_cv / 100.0 + volts_to_low});
    ball.append_basic(Area::Ram, as_bytes(program));
    ball.execute_basic(Area::Ram, 10);
    ball.advance_to(ball.now() + 10s);
    return places.text;
  };
  Watching watching;
  // The battery becomes low at different places in the program, or not at all.
  for (const double volts : {1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 0.5})
    EXPECT_EQ(run(volts, nullptr), run(volts, &watching));
}

} // namespace
} // namespace orb::vm
