// Measures the time and memory of going back in a run of an hour.

#include "debug/timeline.h"

#include <benchmark/benchmark.h>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace orb;

class Silence final : public debug::Audience {
public:
  void on_event(Duration, const vm::Event&) override {}
};

class EveryStep final : public debug::Watch {
public:
  bool line() override { return true; }
  bool command() override { return true; }
};

class Nothing final : public debug::Watch {
public:
  bool wants_lines() const override { return false; }
};

/// A program that keeps a ball busy: it never waits, drives and changes colours.
constexpr auto program = "10 X = X + 1\n"
                         "20 if X % 3000 > 0 then goto 10\n"
                         "30 goroll X / 3000 % 4 * 90,100,1\n"
                         "40 RGB X % 256,0,255\n"
                         "50 if xpos > 200 then Y = Y + 1\n"
                         "60 goto 10\n";

/// A run after an hour of robot time.
struct Hour {
  std::vector<run::Input> inputs;
  run::Options options;
  Silence silence;
  std::unique_ptr<debug::Timeline> timeline;

  Hour() {
    structured::NoFiles files;
    inputs.push_back(*run::read_input("hour.bas", program, "", {}, files));
    timeline = *debug::Timeline::start(inputs, options, silence, nullptr);
    Nothing nothing;
    timeline->forward(nothing, 1h, [] { return false; });
  }
};

void tell_size(benchmark::State& state, const debug::Timeline& timeline) {
  state.counters["steps"] = static_cast<double>(timeline.now().step);
  state.counters["copies"] = static_cast<double>(timeline.size().copies);
  state.counters["KB_of_copies"] = static_cast<double>(timeline.size().bytes) / 1024;
}

void an_hour_forward(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(Hour());
}

/// Starts where no step back has been made yet, so that no copy is near.
void first_step_back(benchmark::State& state) {
  Hour hour;
  EveryStep every;
  Nothing nothing;
  for (auto _ : state) {
    hour.timeline->back(every, [] { return false; });
    state.PauseTiming();
    hour.timeline->forward(nothing, hour.timeline->time() + 10s, [] { return false; });
    state.ResumeTiming();
  }
  tell_size(state, *hour.timeline);
}

void next_step_back(benchmark::State& state) {
  Hour hour;
  EveryStep every;
  for (auto _ : state)
    hour.timeline->back(every, [] { return false; });
  tell_size(state, *hour.timeline);
}

void to_the_beginning_and_back(benchmark::State& state) {
  Hour hour;
  const auto end = hour.timeline->now();
  const debug::Moment begin{0, true, {}};
  for (auto _ : state) {
    hour.timeline->go_to(begin);
    hour.timeline->go_to(end);
  }
}

BENCHMARK(an_hour_forward)->Unit(benchmark::kMillisecond);
BENCHMARK(first_step_back)->Unit(benchmark::kMillisecond);
BENCHMARK(next_step_back)->Unit(benchmark::kMillisecond);
BENCHMARK(to_the_beginning_and_back)->Unit(benchmark::kMillisecond);

} // namespace
