// Measures `orb test`: 10,000 runs of a 30 s program, on two threads. Variants without the judges
// that look at every step, without driving, or with few lines show which part costs how much.

#include "testing/run_suite.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <string>

namespace {

using namespace orb;

constexpr std::uint64_t runs = 10'000;
constexpr unsigned threads = 2;

/// 15 times: a second at `speed`, then a second of rest.
std::string program(int speed) {
  return fmt::format("10 for I = 1 to 15\n20 goroll rnd 359,{},1\n30 delay 1000\n40 goroll 0,0,0\n"
                     "50 delay 1000\n60 print \"lap\", I\n70 next I\n",
                     speed);
}

class OneProgram final : public structured::Files {
public:
  explicit OneProgram(std::string text) : text_(std::move(text)) {}
  std::optional<std::string> read(const std::string& path) override {
    return path == "p.bas" ? std::optional(text_) : std::nullopt;
  }

private:
  std::string text_;
};

class Silent final : public testing::Progress {
public:
  void on_cases(std::uint64_t, std::uint64_t) override {}
};

void run(benchmark::State& state, std::string text, std::string_view expectations) {
  OneProgram files(std::move(text));
  const auto suite = testing::make_suite(
      {{"p.test", fmt::format("for 60s\nseeds 1..{}\n{}", runs, expectations)}}, {}, files);
  Silent silent;
  for (auto _ : state) {
    const auto results = testing::run_suite(*suite, {threads, {}}, silent);
    if (testing::totals_of(results).failed > 0)
      state.SkipWithError("a test fails");
  }
  state.counters["per_run"] = benchmark::Counter(
      runs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

constexpr std::string_view of_prints = "expect print \"lap 15\"\nexpect lines < 200\n";
constexpr std::string_view of_places = "expect near 0,0 by 10m at end\nnever beyond x>2000\n";

void drives_judged_at_each_step(benchmark::State& state) {
  run(state, program(100), std::string(of_prints) + std::string(of_places));
}
void drives(benchmark::State& state) {
  run(state, program(100), of_prints);
}
void rests(benchmark::State& state) {
  run(state, program(0), of_prints);
}
void hardly_runs(benchmark::State& state) {
  run(state, "10 print \"lap\", 15\n", of_prints);
}

// One iteration each, as they take seconds. Processor time covers both threads.
BENCHMARK(drives_judged_at_each_step)
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(drives)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(rests)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(hardly_runs)
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

} // namespace
