#include "structured/lift/lift.h"

#include "compiler/check.h"
#include "compiler/load.h"
#include "random_structured.h"
#include "structured/compile.h"
#include "structured/layout/format.h"
#include "tests/random_program.h"
#include "vm/machine/machine.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>

namespace orb::structured {
namespace {

/// The number of programs: ORB_PROGRAMS, which ./dev fuzz sets, or enough for a second or two.
std::uint64_t how_many(std::uint64_t usually) {
  const char* wanted = std::getenv("ORB_PROGRAMS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : usually;
}

/// Records prints and actions of a program, in order; a print in pieces is one entry.
class Trace final : public vm::Host {
public:
  std::int32_t read(spec::Variable variable, Instant) override {
    const auto value = values_[variable];
    if (spec::info(variable).access == spec::Access::ReadClears)
      values_[variable] = 0;
    return value;
  }
  std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                        Instant) override {
    values_[variable] = value != 0 ? 1 : 0; // only `ctrl` can be set
    add(std::string(spec::info(variable).word) + " = " + std::to_string(value));
    return std::nullopt;
  }
  std::optional<spec::BasicError>
  perform(spec::Statement statement, std::span<const std::int32_t> arguments, Instant) override {
    std::string event{spec::info(statement).word};
    const bool sleeps = statement == spec::Statement::Sleep; // the line numbers differ
    for (const auto argument : arguments.first(sleeps ? 2 : arguments.size()))
      event += " " + std::to_string(argument);
    if (statement == spec::Statement::Goroll && arguments.size() == 2)
      event += arguments[1] > 0 ? " 1" : " 0"; // the default of the third
    if (sleeps)
      end = "sleep";
    add(std::move(event));
    return std::nullopt;
  }
  std::optional<Instant> print(std::string_view text, Instant) override {
    if (!printing_)
      add("print ");
    printing_ = true;
    events.back() += text;
    return std::nullopt;
  }
  void line_ended(int, Instant) override {}

  std::vector<std::string> events;
  std::string end = "running";

private:
  void add(std::string event) {
    events.push_back(std::move(event));
    printing_ = false;
  }

  std::map<spec::Variable, std::int32_t> values_ = {
      {spec::Variable::Speed, 77},  {spec::Variable::Yaw, 350},  {spec::Variable::Xpos, -12},
      {spec::Variable::Cmdroll, 1}, {spec::Variable::Dshake, 1}, {spec::Variable::Sbatt, 2}};
  bool printing_ = false;
};

/// Runs a numbered program from its first line for a limited number of lines. Lines take almost no
/// time, so that programs of different length read the same timers.
Trace run(std::string_view text, std::uint64_t most_lines) {
  constexpr std::uint32_t lines_per_second = 1'000'000'000;
  Trace trace;
  vm::Machine machine(lines_per_second, 1);
  auto chunk = compiler::load(text);
  const int first = chunk.lines.empty() ? 0 : chunk.lines.front().number;
  machine.start(std::move(chunk), first, Instant{});
  while (machine.running() && machine.next_event() != never && machine.lines() < most_lines &&
         trace.end == "running")
    machine.run(std::max(machine.next_event(), machine.now()) + 10us, trace);
  if (const auto stop = machine.take_termination(); stop && trace.end == "running")
    trace.end = stop->error ? spec::info(*stop->error).text : "end";
  return trace;
}

std::string joined(const std::vector<std::string>& events) {
  std::string text;
  for (const auto& event : events)
    text += event + "\n";
  return text.substr(0, 1500);
}

/// A print that is too long for the robot arrives whole from a structured program.
bool prints_too_much(const Trace& trace) {
  return std::any_of(trace.events.begin(), trace.events.end(), [](const std::string& event) {
    return event.find("(print exceeds") != std::string::npos;
  });
}

void expect_same(const Trace& numbered, const Trace& lifted) {
  if (numbered.end != "running" && lifted.end != "running") {
    ASSERT_EQ(joined(numbered.events), joined(lifted.events));
    ASSERT_EQ(numbered.end, lifted.end);
    return;
  }
  const auto both = std::min(numbered.events.size(), lifted.events.size());
  for (std::size_t i = 0; i + 1 < both; ++i) // the last print may be incomplete
    ASSERT_EQ(numbered.events[i], lifted.events[i]);
}

/// Returns the errors that prevent lifting a program.
std::vector<Diagnostic> errors_of(std::string_view text) {
  auto errors = lift(compiler::check(text, {})).findings;
  std::erase_if(errors, [](const Diagnostic& found) { return !is_error(found); });
  return errors;
}

/// Lifts a program without errors, compiles the result and compares the effects of both.
void compare(std::string_view text) {
  const auto checked = compiler::check(text, {});
  const auto lifted = lift(checked);
  SCOPED_TRACE("numbered:\n" + std::string(text) + "\nlifted:\n" + lifted.text);
  ASSERT_EQ(format(lifted.text), lifted.text);
  NoFiles files;
  const auto compiled = compile("lifted.orb", "lifted.orb", lifted.text, {}, files);
  ASSERT_FALSE(compiled.has_errors());
  const auto numbered = run(text, 4000);
  if (!prints_too_much(numbered))
    expect_same(numbered, run(compiled.robot.text, 16000));
}

/// Returns a random program in which each line that prevents lifting prints its number instead, or,
/// if it already does, ends the program.
std::string liftable(std::uint64_t seed) {
  testing::RandomProgram::Style style;
  style.lines = 4 + static_cast<int>(seed % 14);
  style.wild_jump = 0;
  auto text = testing::RandomProgram(seed, style).write();
  for (int turn = 0; turn < 3 * style.lines; ++turn) {
    const auto errors = errors_of(text);
    if (errors.empty())
      return text;
    const Source source("", text);
    const auto line = source.position(errors.front().span.begin).line;
    const auto number = std::to_string(10 * line);
    const auto prints = number + " print " + number;
    const bool again = source.line(line) == prints;
    text.replace(source.line_start(line), source.line(line).size(),
                 again ? number + " end" : prints);
  }
  return {};
}

TEST(Lift, RandomProgramsDoTheSame) {
  const auto programs = how_many(1500);
  std::uint64_t lifted = 0;
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    if (const auto text = liftable(seed); !text.empty()) {
      ++lifted;
      compare(text);
    }
  EXPECT_GT(lifted, programs * 9 / 10);
  RecordProperty("lifted", std::to_string(lifted));
}

TEST(Lift, CompiledProgramsDoTheSame) {
  std::uint64_t lifted = 0;
  const auto programs = how_many(600);
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed) {
    using Style = testing::RandomStructured::Style;
    const auto style = seed % 2 == 0 ? Style::Any : Style::Habits;
    NoFiles files;
    const auto compiled = compile("random.orb", "random.orb",
                                  testing::RandomStructured(seed, style).write(), {}, files);
    if (compiled.has_errors() || !compiled.runs || !errors_of(compiled.robot.text).empty())
      continue;
    ++lifted;
    SCOPED_TRACE("seed " + std::to_string(seed));
    compare(compiled.robot.text);
  }
  EXPECT_GT(lifted, programs / 4);
  RecordProperty("lifted", std::to_string(lifted));
}

/// A robot's loop runs once if its end is before its start, on every path to it.
TEST(Lift, ALoopThatOneWayBringsPastItsEndRunsOnce) {
  for (const std::string test : {"speed < 200", "speed > 200"})
    compare("10 C = 4\n20 if " + test +
            " then C = dshake\n30 for H = 2 to C - 1\n40 print H\n50 next H\n60 print C\n");
}

TEST(Lift, AProgramWithErrorsIsRefused) {
  testing::RandomProgram::Style style;
  style.lines = 30;
  style.broken = 0.1;
  style.wild_jump = 0.1;
  for (std::uint64_t seed = 1; seed <= how_many(300); ++seed) {
    const auto text = testing::RandomProgram(seed, style).write();
    const auto checked = compiler::check(text, {});
    const auto lifted = lift(checked);
    if (any_error(checked.diagnostics)) {
      EXPECT_TRUE(lifted.text.empty()) << text;
      EXPECT_TRUE(any_error(lifted.findings)) << text;
    }
  }
}

TEST(Lift, AnyProgramIsLiftedOrRefused) {
  testing::RandomProgram::Style style;
  style.lines = 60;
  for (std::uint64_t seed = 1; seed <= how_many(300); ++seed) {
    const auto text = testing::RandomProgram(seed, style).write();
    for (const auto& found : errors_of(text)) {
      EXPECT_LE(found.span.begin, found.span.end);
      EXPECT_LE(found.span.end, text.size());
      EXPECT_FALSE(found.message.empty());
    }
  }
}

} // namespace
} // namespace orb::structured
