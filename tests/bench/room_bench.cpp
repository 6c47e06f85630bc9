// Measures a minute of 200 balls: each alone, and all in one room, where contacts are searched for;
// and the search by itself, with balls that cost nothing. The arguments are walls (0 or 1) and the
// size of the room in metres.

#include "base/random.h"
#include "run/room.h"
#include "structured/text/files.h"
#include "vm/body/angles.h"
#include "vm/room/room.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace {

using namespace orb;

constexpr int count = 200;

/// Drives at random, reads its position, and repeats.
constexpr std::string_view program =
    "10 basflg 1\n20 goroll rnd 360 - 1,30 + rnd 70,1\n30 delay 300 + rnd 1500\n"
    "40 A = xpos * xpos + ypos * ypos\n50 goto 20\n";

class NoFiles final : public structured::Files {
public:
  std::optional<std::string> read(const std::string&) override { return std::nullopt; }
};

class Nobody final : public run::Listener {
  void on_event(Duration, const vm::Event&) override {}
  void on_fault(Duration, const run::ProgramError&) override {}
};

struct Balls {
  Balls(double metres, bool walled) {
    NoFiles files;
    inputs.push_back(*run::read_input("p.bas", std::string(program), "", {}, files));
    constexpr int columns = 15;
    const double apart = 100 * metres / columns;
    for (int i = 0; i < count; ++i) {
      auto& ball = balls.emplace_back();
      ball.name = fmt::format("ball{:03}", i);
      ball.inputs = inputs;
      ball.listener = &nobody;
      ball.options.start = {{apart * (i % columns), apart * (i / columns)}, 0};
      ball.options.seed = run::seed_of(1, ball.name);
      ball.options.native_programs = &native;
      const double low = -apart / 2;
      const double high = 100 * metres - apart / 2;
      if (walled)
        for (const auto& wall :
             {vm::Wall{vm::Wall::Axis::X, low, {}, {}}, vm::Wall{vm::Wall::Axis::X, high, {}, {}},
              vm::Wall{vm::Wall::Axis::Y, low, {}, {}}, vm::Wall{vm::Wall::Axis::Y, high, {}, {}}})
          ball.options.stimuli.push_back({{}, wall});
    }
  }
  vm::NativePrograms native;
  Nobody nobody;
  std::vector<run::Input> inputs;
  std::vector<run::RoomBall> balls;
};

/// A ball without a body: it moves straight ahead, and turns back at walls and other balls.
class Hiker final : public vm::Resident {
public:
  Hiker(vm::Point place, vm::Point velocity, const vm::Point* corner)
      : mover_{place, velocity}, corner_(corner) {}
  void advance_to(Duration t) override {
    const double time = std::chrono::duration<double>(t - now_).count();
    now_ = t;
    go(mover_.place.x, mover_.velocity.x, time, corner_ == nullptr ? nullptr : &corner_->x);
    go(mover_.place.y, mover_.velocity.y, time, corner_ == nullptr ? nullptr : &corner_->y);
  }
  vm::Mover mover() const override { return mover_; }
  vm::Outlook outlook() const override {
    return {mover_.place, std::hypot(mover_.velocity.x, mover_.velocity.y), Duration::max()};
  }
  void meet(const vm::Shove& shove, std::span<const std::string>) override {
    mover_.velocity.x += shove.change.x;
    mover_.velocity.y += shove.change.y;
  }

private:
  static void go(double& at, double& speed, double time, const double* end) {
    at += speed * time;
    if (end != nullptr && ((at < 0 && speed < 0) || (at > *end && speed > 0)))
      speed = -speed;
  }
  vm::Mover mover_;
  const vm::Point* corner_; ///< the corner opposite 0,0; null: no walls
  Duration now_{};
};

void each_alone(benchmark::State& state) {
  Balls all(static_cast<double>(state.range(1)), state.range(0) != 0);
  for (auto _ : state)
    for (const auto& ball : all.balls)
      benchmark::DoNotOptimize(run::run(ball.inputs, ball.options, all.nobody, nullptr));
}
void together(benchmark::State& state) {
  Balls all(static_cast<double>(state.range(1)), state.range(0) != 0);
  for (auto _ : state)
    benchmark::DoNotOptimize(run::run_room(all.balls));
}

void search(benchmark::State& state) {
  const double side = 100 * static_cast<double>(state.range(1));
  const vm::Point corner{side, side};
  for (auto _ : state) {
    Random random{1};
    std::deque<Hiker> hikers;
    vm::Room room;
    for (int i = 0; i < count; ++i) {
      constexpr int columns = 15;
      const double speed = 30 + static_cast<double>(random.next() % 70); // of 255
      const double way = static_cast<double>(random.next() % 360) * vm::to_radians;
      const double cm_s = speed / spec::ball::greatest * spec::ball::full_speed;
      const vm::Point place{side / columns * (i % columns + 0.5),
                            side / columns * (i / columns + 0.5)};
      hikers.emplace_back(place, vm::Point{cm_s * std::sin(way), cm_s * std::cos(way)},
                          state.range(0) != 0 ? &corner : nullptr);
      room.add(fmt::format("ball{:03}", i), hikers.back());
    }
    room.advance_to(std::chrono::minutes{1});
    benchmark::DoNotOptimize(hikers.back().mover());
  }
}

// walls (0 or 1), metres
void rooms(benchmark::internal::Benchmark* bench) {
  for (const auto metres : {10, 20, 40})
    bench->Args({1, metres});
  bench->Args({0, 20})->Unit(benchmark::kMillisecond)->MinTime(2);
}
BENCHMARK(each_alone)->Apply(rooms);
BENCHMARK(together)->Apply(rooms);
BENCHMARK(search)->Apply(rooms);

} // namespace
