#include "base/random.h"
#include "plain_evaluator.h"
#include "random_lines.h"
#include "tests/random_program.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>

namespace orb::vm {
namespace {

constexpr std::uint64_t most_lines = 300;
constexpr std::uint32_t speed = 3000;

/// How many programs: ORB_PROGRAMS, which ./dev fuzz sets, or enough for a second.
std::uint64_t how_many() {
  const char* wanted = std::getenv("ORB_PROGRAMS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 2000;
}

void prepare(NotebookHost& host) {
  host.values[spec::Variable::Speed] = 77;
  host.values[spec::Variable::Yaw] = 350;
  host.values[spec::Variable::Cmdroll] = 1;
}

/// Runs as many lines as the evaluator may, in pieces whose lengths change all the time.
void run_machine(Machine& machine, NotebookHost& host, std::uint64_t seed) {
  Instant limit{};
  for (std::uint64_t piece = seed; machine.running() && machine.lines() < most_lines; ++piece) {
    // Never beyond the last line that counts: lines end on a grid while nothing waits.
    limit = std::max(limit, std::min(machine.next_event(), never - 1h)) +
            Duration{1 + static_cast<std::int64_t>(piece % 5) * 400'000};
    const auto left = static_cast<std::int64_t>(most_lines - machine.lines());
    limit = std::min(limit, machine.next_event() == never
                                ? never
                                : machine.next_event() +
                                      Duration{(left - 1) * (1'000'000'000 / speed)} + Duration{1});
    if (machine.next_event() == never)
      return;
    machine.run(limit, host);
  }
  // The evaluator's last line ends with its wait.
  if (machine.waits_for_input() && machine.next_event() != never)
    machine.run(machine.next_event() + Duration{1}, host);
}

std::string write_program(std::uint64_t seed) {
  if (seed % 2 == 0)
    return RandomLines(seed).write();
  return testing::RandomProgram(seed, {.lines = 25, .broken = 0.01}).write();
}

/// A way to run programs; all must do the same.
struct Engine {
  Dispatch dispatch = Dispatch::Threaded;
  Native native = Native::Off;
};
constexpr Engine engines[] = {{Dispatch::Threaded, Native::Off},
                              {Dispatch::Switch, Native::Off},
                              {Dispatch::Threaded, Native::On}};

void compare(std::uint64_t seed, Engine engine) {
  const auto text = write_program(seed);
  SCOPED_TRACE("seed " + std::to_string(seed) + ":\n" + text +
               bytecode::listing(compiler::load(text)));
  NotebookHost plain_host;
  prepare(plain_host);
  PlainEvaluator plain(text, plain_host, speed, seed);
  plain.run(most_lines);

  NotebookHost host;
  prepare(host);
  Machine machine(speed, seed, engine.dispatch, engine.native);
  auto chunk = compiler::load(text);
  ASSERT_EQ(bytecode::verify(chunk), std::nullopt);
  const int line = chunk.lines.front().number;
  machine.start(std::move(chunk), line, Instant{});
  run_machine(machine, host, seed);

  std::string end = "running";
  if (const auto stop = machine.take_stop())
    end = stop->error ? "Line " + std::to_string(stop->line) + ": " +
                            std::string(spec::info(*stop->error).text)
                      : "end";
  ASSERT_EQ(machine.lines(), plain.lines);
  if (plain.lines < most_lines) {
    ASSERT_EQ(end, plain.end);
  }
  ASSERT_EQ(host.printed, plain_host.printed);
  ASSERT_EQ(host.notes, plain_host.notes);
  ASSERT_EQ(host.times, plain_host.times);
  ASSERT_EQ(host.print_times, plain_host.print_times);
  for (std::size_t i = 0; i < 25; ++i) {
    ASSERT_EQ(machine.variable(i), plain.letter(i)) << static_cast<char>('A' + i);
    ASSERT_EQ(machine.variable(bytecode::first_element + i), plain.element(i)) << "Z " << i + 1;
  }
}

TEST(Agreement, TheMachineDoesWhatTheTextSays) {
  const auto programs = how_many();
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare(seed, engines[seed % std::size(engines)]);
}

/// Everything that a program has come to, as text; between lines temporaries mean nothing.
std::string shown(Machine& machine, const NotebookHost& host) {
  const auto& core = machine.core();
  const auto& frames = core.frames;
  auto out = fmt::format(
      "line {} at {} of {}, {} print {}\n{}\n", machine.lines(), core.index_of(core.pc),
      machine.running(), machine.now().time_since_epoch().count(), host.printed,
      fmt::join(core.registers.begin(), core.registers.begin() + bytecode::first_temporary, " "));
  for (const Loop* loop = frames.loops.data() + 1; loop <= frames.loop; ++loop)
    out += fmt::format("for {} to {} by {} at {}\n", loop->variable, loop->end, loop->step,
                       loop->body);
  out += fmt::format("calls {}\n{}\n",
                     fmt::join(frames.calls.begin(), frames.calls.begin() + frames.call_depth, " "),
                     fmt::join(host.notes, "\n"));
  if (const auto stop = machine.take_stop())
    out += fmt::format("stop {} {}", stop->line, stop->error ? spec::code(*stop->error) : 0);
  return out;
}

/// Runs `text` on each engine in slices of 1 to 100 lines, and looks after each of them.
void compare_slices(const std::string& text, std::uint64_t seed) {
  constexpr std::size_t count = std::size(engines);
  std::array<NotebookHost, count> hosts;
  std::vector<std::unique_ptr<Machine>> machines;
  for (std::size_t i = 0; i < count; ++i) {
    prepare(hosts[i]);
    machines.push_back(
        std::make_unique<Machine>(1'000'000'000, seed, engines[i].dispatch, engines[i].native));
    auto chunk = compiler::load(text);
    const int line = chunk.lines.empty() ? 0 : chunk.lines.front().number;
    machines[i]->start(std::move(chunk), line, Instant{});
  }
  Random random{seed};
  while (machines[0]->running() && machines[0]->next_event() != never &&
         machines[0]->lines() < 1000) {
    // A line takes a nanosecond.
    const auto limit =
        machines[0]->next_event() + Duration{1 + static_cast<std::int64_t>(random.below(100))};
    std::array<std::string, count> after;
    for (std::size_t i = 0; i < count; ++i) {
      while (machines[i]->running() && machines[i]->next_event() < limit)
        machines[i]->run(limit, hosts[i]);
      after[i] = shown(*machines[i], hosts[i]);
      ASSERT_EQ(after[i], after[0]) << "engine " << i << ", seed " << seed << ":\n"
                                    << text << native_listing(compiler::load(text));
    }
  }
}

TEST(Agreement, EnginesAgreeAfterEverySlice) {
  for (std::uint64_t seed = 1; seed <= how_many() && !::testing::Test::HasFailure(); ++seed)
    compare_slices(write_program(seed), seed);
}

/// A program of which some bytes have been changed, lost or doubled.
std::string damaged(std::uint64_t seed) {
  Random random{seed};
  auto text = write_program(seed);
  for (std::uint64_t n = 1 + random.below(12); n > 0 && !text.empty(); --n) {
    const auto at = static_cast<std::size_t>(random.below(text.size()));
    switch (random.below(3)) {
    case 0: text[at] = static_cast<char>(random.below(256)); break;
    case 1: text.erase(at, 1); break;
    default: text.insert(at, text.substr(at, static_cast<std::size_t>(random.below(20)))); break;
    }
  }
  return text;
}

TEST(AnyText, RunsTheSameOnBothEngines) {
  for (std::uint64_t seed = 1; seed <= how_many() / 4; ++seed) {
    const auto text = damaged(seed);
    ASSERT_EQ(bytecode::verify(compiler::load(text)), std::nullopt) << text;
    const auto threaded = run_basic(text, 100ms, -1, Dispatch::Threaded);
    const auto by_switch = run_basic(text, 100ms, -1, Dispatch::Switch);
    ASSERT_EQ(threaded.printed, by_switch.printed) << text;
    ASSERT_EQ(threaded.end, by_switch.end) << text;
    ASSERT_EQ(threaded.lines, by_switch.lines) << text;
  }
}

TEST(Agreement, RandomLinesRunFar) {
  // Programs that all stop at once would prove nothing.
  std::uint64_t lines = 0;
  std::uint64_t long_ones = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    NotebookHost host;
    const auto text = RandomLines(seed).write(); // the evaluator views it
    PlainEvaluator plain(text, host, speed, seed);
    plain.run(most_lines);
    lines += plain.lines;
    long_ones += plain.lines >= 50 ? 1 : 0;
  }
  EXPECT_GT(lines, 500 * 15u);
  EXPECT_GT(long_ones, 30u);
}

} // namespace
} // namespace orb::vm
