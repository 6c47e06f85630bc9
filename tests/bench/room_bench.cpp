// How long 200 balls take for a minute: each alone, and all in one room, where contacts are looked
// for. On an open floor and between four walls; the second argument is the size of the room in
// metres.

#include "run/room.h"
#include "structured/text/files.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace {

using namespace orb;

constexpr int count = 200;

/// Drives anywhere, looks where it is, and goes on.
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
    inputs.push_back(
        *run::read_input("p.bas", std::string(program), "", {}, run::Lint::Off, files));
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

// walls (0 or 1), metres
void rooms(benchmark::internal::Benchmark* bench) {
  for (const auto metres : {10, 20, 40})
    bench->Args({1, metres});
  bench->Args({0, 20})->Unit(benchmark::kMillisecond)->MinTime(2);
}
BENCHMARK(each_alone)->Apply(rooms);
BENCHMARK(together)->Apply(rooms);

} // namespace
