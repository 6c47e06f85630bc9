#include "base/random.h"
#include "plain_evaluator.h"
#include "random_lines.h"
#include "tests/random_program.h"

#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>

namespace orb::vm {
namespace {

constexpr std::uint64_t most_lines = 300;
constexpr std::uint32_t speed = 3000;

constexpr std::uint64_t enough_for_a_second = 2000;

/// The number of programs: ORB_PROGRAMS, which ./dev fuzz sets, or enough for a second.
std::uint64_t how_many() {
  const char* wanted = std::getenv("ORB_PROGRAMS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : enough_for_a_second;
}

void prepare(NotebookHost& host) {
  host.values[spec::Variable::Speed] = 77;
  host.values[spec::Variable::Yaw] = 350;
  host.values[spec::Variable::Cmdroll] = 1;
}

/// Runs as many lines as the evaluator may, in pieces of varying length.
void run_machine(Machine& machine, NotebookHost& host, std::uint64_t seed) {
  Instant limit{};
  for (std::uint64_t piece = seed; machine.running() && machine.lines() < most_lines; ++piece) {
    // Never beyond the last line that counts: lines end on a grid unless one waits.
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
  // The evaluator's last line includes its wait.
  if (machine.waits_for_input() && machine.next_event() != never)
    machine.run(machine.next_event() + Duration{1}, host);
}

std::string write_program(std::uint64_t seed) {
  if (seed % 2 == 0)
    return RandomLines(seed).write();
  return testing::RandomProgram(seed, {.lines = 25, .broken = 0.01}).write();
}

/// A way to run programs. All must give the same results.
struct Engine {
  Dispatch dispatch = Dispatch::Threaded;
  Native native = Native::Off;
};
constexpr Engine engines[] = {{Dispatch::Threaded, Native::Off},
                              {Dispatch::Switch, Native::Off},
                              {Dispatch::Threaded, Native::On}};

/// Returns how a program ended, in the words of the plain evaluator; empty while it runs.
std::string ending(Machine& machine) {
  const auto stop = machine.take_termination();
  if (!stop)
    return "";
  return stop->error ? "Line " + std::to_string(stop->line) + ": " +
                           std::string(spec::info(*stop->error).text)
                     : "end";
}

/// Expects that both have executed the same number of lines.
void expect_equal(const Machine& machine, const NotebookHost& host, const PlainEvaluator& plain,
                  const NotebookHost& plain_host) {
  ASSERT_EQ(machine.lines(), plain.lines);
  ASSERT_EQ(host.printed, plain_host.printed);
  ASSERT_EQ(host.notes, plain_host.notes);
  ASSERT_EQ(host.times, plain_host.times);
  ASSERT_EQ(host.print_times, plain_host.print_times);
  for (std::size_t i = 0; i < 25; ++i) {
    ASSERT_EQ(machine.variable(i), plain.letter(i)) << static_cast<char>('A' + i);
    ASSERT_EQ(machine.variable(bytecode::first_element + i), plain.element(i)) << "Z " << i + 1;
  }
}

std::string listing_of(const std::string& text) {
  const auto chunk = compiler::load(text);
  return fmt::format("{}\n{}{}", text, bytecode::listing(chunk),
                     fmt::join(native_listing(chunk).lines, "\n"));
}

void compare(std::uint64_t seed, Engine engine) {
  const auto text = write_program(seed);
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
  ASSERT_NO_FATAL_FAILURE(expect_equal(machine, host, plain, plain_host))
      << "seed " << seed << ": " << listing_of(text);
  if (plain.lines < most_lines) {
    const auto end = ending(machine);
    ASSERT_EQ(end.empty() ? "running" : end, plain.end) << listing_of(text);
  }
}

TEST(Agreement, TheMachineDoesWhatTheTextSays) {
  const auto programs = how_many();
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare(seed, engines[seed % std::size(engines)]);
}

/// Returns the whole state of a program as text; temporaries have no meaning between lines.
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
  return out;
}

constexpr std::int64_t longest_slice = 100;
/// How often a slice of each length ran.
using SliceCounts = std::array<std::uint64_t, longest_slice + 1>;

/// A program on each engine and on the plain evaluator; a line takes a nanosecond.
class SideBySide {
public:
  SideBySide(const std::string& text, std::uint64_t seed)
      : text_(text), plain_(text_, plain_host_, rate, seed) {
    prepare(plain_host_);
    for (std::size_t i = 0; i < std::size(engines); ++i) {
      prepare(hosts_[i]);
      auto chunk = compiler::load(text_);
      const int line = chunk.lines.empty() ? 0 : chunk.lines.front().number;
      machines_.push_back(
          std::make_unique<Machine>(rate, seed, engines[i].dispatch, engines[i].native));
      machines_.back()->start(std::move(chunk), line, Instant{});
    }
  }

  bool goes_on() const {
    return machines_[0]->next_event() != never && machines_[0]->lines() < 1000;
  }

  /// Runs this many lines on all of them, unless one waits, and compares.
  void run(std::int64_t lines, SliceCounts& counts) {
    const auto before = machines_[0]->lines();
    const auto limit = machines_[0]->next_event() + Duration{lines};
    std::string first;
    std::string end;
    for (std::size_t i = 0; i < machines_.size(); ++i) {
      while (machines_[i]->running() && machines_[i]->next_event() < limit)
        machines_[i]->run(limit, hosts_[i]);
      const auto after = shown(*machines_[i], hosts_[i]) + (end = ending(*machines_[i]));
      if (i == 0)
        first = after;
      ASSERT_EQ(after, first) << "engine " << i << ": " << listing_of(text_);
    }
    ++counts[machines_[0]->lines() - before];
    plain_.run(machines_[0]->lines());
    if (machines_[0]->waits_for_input()) // the evaluator has the number at once
      return;
    ASSERT_NO_FATAL_FAILURE(expect_equal(*machines_[0], hosts_[0], plain_, plain_host_))
        << listing_of(text_);
    if (!end.empty() && end != "end") { // the evaluator reports the end only when continued
      ASSERT_EQ(end, plain_.end) << listing_of(text_);
    }
  }

private:
  static constexpr std::uint32_t rate = 1'000'000'000;

  std::string text_;
  NotebookHost plain_host_;
  PlainEvaluator plain_;
  std::array<NotebookHost, std::size(engines)> hosts_;
  std::vector<std::unique_ptr<Machine>> machines_;
};

TEST(Agreement, EnginesAgreeAfterEverySlice) {
  SliceCounts counts{};
  for (std::uint64_t seed = 1; seed <= how_many() && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SideBySide all(write_program(seed), seed);
    Random random{seed};
    while (all.goes_on() && !::testing::Test::HasFailure())
      all.run(1 + static_cast<std::int64_t>(random.below(longest_slice)), counts);
  }
  if (how_many() < enough_for_a_second) // smaller numbers, as under valgrind, miss a length
    return;
  for (std::size_t lines = 1; lines <= longest_slice && !::testing::Test::HasFailure(); ++lines)
    EXPECT_GT(counts[lines], 0u) << "no slice had " << lines << " lines";
}

TEST(Agreement, DivisionByConstantsIsExact) {
  SliceCounts counts{};
  for (const std::string divisor :
       {"1", "2", "3", "4", "5", "7", "8", "10", "25", "641", "65536", "65537", "1073741824",
        "1431655765", "2147483646", "2147483647"})
    for (const std::string value : {"0", "1", "2", "3", "7", "8", "9", "65535", "65536",
                                    "2147483646", "2147483647", "2147483647+1"})
      for (const std::string sign : {"", "0-"}) {
        const auto text = fmt::format("10 X={0}({1})\n20 A=X/{2}\n30 B=X%{2}\n40 X=X/{2}+A*A+B\n"
                                      "50 if A%{2}=0 then C=1\n60 if A%{2}!0 then D=1\n"
                                      "70 if X%{2}=0 then E=X-A/{2} else E=A%{2}+X\n",
                                      sign, value, divisor);
        SideBySide all(text, 1);
        while (all.goes_on() && !::testing::Test::HasFailure())
          all.run(longest_slice, counts);
      }
}

/// Machine code inlines short subroutines without a frame. Wherever it is left, the frames must
/// equal those of the loop.
TEST(Agreement, SubroutinesCanBeLeftAnywhere) {
  constexpr std::array statements{"B=A/D",   "Z=A",       "B=C%D",
                                  "print A", "gosub 400", "delay 1",
                                  "return",  "goto 330",  "if A%3=0 then return"};
  SliceCounts counts{};
  for (const std::string outer : statements)
    for (const std::string inner : statements) {
      const auto text = fmt::format(
          "10 for A=1 to 6\n20 D=4-A\n30 Y=A*5\n40 gosub 100\n50 next A\n60 end\n"
          "100 gosub 200\n110 C=C+1\n120 return\n200 gosub 300\n210 E=E+1\n220 return\n"
          "300 F=F+1\n310 {}\n320 gosub 400\n330 return\n400 G=G+1\n410 {}\n420 return\n",
          outer, inner);
      for (std::int64_t slice = 1; slice <= 24 && !::testing::Test::HasFailure(); ++slice) {
        SideBySide all(text, 1);
        while (all.goes_on() && !::testing::Test::HasFailure())
          all.run(slice, counts);
      }
    }
}

/// Returns a program with some bytes changed, lost or doubled.
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
  // Programs that stop at once would prove nothing.
  std::uint64_t lines = 0;
  std::uint64_t long_ones = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    NotebookHost host;
    const auto text = RandomLines(seed).write(); // the evaluator refers to it
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
