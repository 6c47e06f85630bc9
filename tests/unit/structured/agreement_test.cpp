#include "base/random.h"
#include "compiler/check.h"
#include "compiler/text/rules.h"
#include "random_structured.h"
#include "structured/compile.h"
#include "structured/text/rules.h"
#include "tree_evaluator.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace orb::structured {
namespace {

/// The number of programs: ORB_PROGRAMS, which ./dev fuzz sets, or enough for a second or two.
std::uint64_t how_many() {
  const char* wanted = std::getenv("ORB_PROGRAMS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 2000;
}

void prepare(vm::NotebookHost& host) {
  host.values[spec::Variable::Speed] = 77;
  host.values[spec::Variable::Yaw] = 350;
  host.values[spec::Variable::Xpos] = -12;
  host.values[spec::Variable::Cmdroll] = 1;
  host.values[spec::Variable::Dshake] = 1;
}

std::string all_findings(const Compiled& compiled) {
  std::string text;
  for (const auto& found : compiled.program.diagnostics)
    text += std::string(found.rule->id) + " at `" +
            std::string(compiled.program.text_of(found.span)) + "`: " + in_english(found.message) +
            "\n";
  return text;
}

/// True for findings about the robot's lines that come from the source, not from the compiler.
bool may_remain(const Diagnostic& found) {
  namespace robot = compiler::rules;
  for (const auto* rule :
       {&robot::BusyLoop, &robot::ClearedByReading, &robot::DataReplaced, &robot::DataExpression,
        &robot::LargerThanOldRam, &robot::UnusedVariable, &robot::MissingGo,
        &robot::ProgramTooLarge, &robot::MissingDelay, &robot::DrivesOn, &robot::LoopLeavesRange,
        &robot::HeadingGrows, &robot::ReadPastData, &robot::ValueOutOfRange,
        &robot::DivisionByZero, // found only by the optimiser
        &robot::IndexBeforeY})  // a loop whose first index is 0, as `Y` is then
    if (found.rule == rule)
      return true;
  // Findings about intentions, which random programs do not have. An index that is wrong in one
  // copy of a statement stops the program there, as it should.
  return found.severity == Severity::Info || found.rule == &robot::IndexRange ||
         found.rule == &robot::MayLeaveRange || found.rule == &robot::ValueGrows ||
         (found.severity == Severity::Warning && found.rule->robot_error == 0);
}

/// Runs the robot's lines to their end, but not forever.
void run(vm::Machine& machine, vm::NotebookHost& host, const std::string& text) {
  auto chunk = compiler::load(text);
  machine.start(std::move(chunk), 1, Instant{});
  while (machine.running() && machine.next_event() != never && machine.lines() < 40000)
    machine.run(std::max(machine.next_event(), machine.now()) + 10ms, host);
}

using Style = testing::RandomStructured::Style;

void compare_text(const std::string& text, std::uint64_t seed) {
  NoFiles files;
  compiler::Target target;
  target.ram_bytes = 4096;
  const auto compiled = compile("random.orb", "random.orb", text, target, files);
  SCOPED_TRACE("seed " + std::to_string(seed) + ":\n" + text + "\n" + compiled.robot.text +
               all_findings(compiled));
  for (const auto& found : compiled.program.diagnostics)
    if (found.severity == Severity::Error) {
      // Wrong constants and programs that do not fit are refused.
      ASSERT_NE(found.rule, &rules::MalformedLine);
      ASSERT_NE(found.rule, &rules::UnknownName);
    }
  if (compiled.robot.lines.empty() || any_error(compiled.program.diagnostics))
    return;

  const auto checked = compiler::check(compiled.robot.text, target);
  for (const auto& found : checked.diagnostics) {
    if (is_error(found) && !keeps_from_building(found))
      continue; // a certain fault stops both
    ASSERT_TRUE(may_remain(found)) << found.rule->id << ": " << in_english(found.message);
  }

  vm::NotebookHost plain_host;
  prepare(plain_host);
  TreeEvaluator plain(compiled.program, compiled.names, plain_host, seed);
  plain.run(4000);

  vm::NotebookHost host;
  prepare(host);
  vm::Machine machine(1'000'000, seed);
  run(machine, host, compiled.robot.text);

  std::erase_if(host.notes, [](const std::string& note) { return note.starts_with("delay"); });
  if (plain.end == "running") {
    const auto printed = std::min(plain_host.printed.size(), host.printed.size());
    ASSERT_TRUE(host.printed.substr(0, printed) == plain_host.printed.substr(0, printed));
    return;
  }
  constexpr std::size_t shown = 400; // of the output of an endless loop
  ASSERT_EQ(host.printed.substr(0, shown), plain_host.printed.substr(0, shown));
  ASSERT_TRUE(host.printed == plain_host.printed);
  ASSERT_TRUE(host.notes == plain_host.notes);
  const auto stop = machine.take_termination();
  ASSERT_TRUE(stop.has_value());
  ASSERT_EQ(stop->error ? std::string(spec::info(*stop->error).text) : "end", plain.end);
  if (!stop->error)
    return;
  const auto& line = compiled.robot.lines[static_cast<std::size_t>(stop->line) - 1];
  const Source source("random.orb", text);
  const auto line_of = [&](std::uint32_t statement) {
    return source.position(compiled.program.statements[statement].span.begin).line;
  };
  ASSERT_EQ(line_of(line.statement), line_of(plain.statement));
}

void compare(std::uint64_t seed, Style style = Style::Any) {
  compare_text(testing::RandomStructured(seed, style).write(), seed);
}

TEST(Agreement, CompiledProgramsDoWhatTheTextSays) {
  const auto programs = how_many();
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare(seed);
}

TEST(Agreement, CompiledHabitsDoWhatTheTextSays) {
  const auto programs = how_many();
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare(seed, Style::Habits);
}

TEST(Agreement, CompiledShortProgramsDoWhatTheTextSays) {
  const auto programs = how_many();
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare(seed, Style::Short);
}

/// A used index is known to be within the array, but not once its variable is dead.
TEST(Agreement, IndicesThatAreReadNoMore) {
  for (const std::string body : {
           "array t[6]\ninput n, 5ms, 3\nn = t[n]\nsay(5)\nsay(n)\n",
           "array t[5]\ninput n, 5ms, 3\nn = t[n]\nsay(5)\nsay(n)\n",
           "array t[6]\ninput n, 5ms, 3\nt[n] = 9\nn = t[n]\nsay(n)\nsay(n + 1)\n",
           "array t[6]\nfor i = 1 to 3\n input n, 5ms, 2\n n = t[n + i]\n say(n)\n say(7)\nnext\n",
       })
    compare_text(body + "sub say(p)\n print p / 3, 4\nend sub\n", 1);
}

/// On the robot, a `for` with the variable of an open loop replaces that loop.
TEST(Agreement, LoopsThatShareAVariable) {
  for (const std::string body : {
           "for i = 1 to 3\n square\nnext\n",
           "for i = 1 to 3\n square\n print i\nnext\nsquare\n",
           "for i = 1 to 3\n i = 1\n while i <= 3\n print i\n i += 1\n end while\nnext\n",
           "for i = 1 to 9\n for j = 1 to 2\n square\n next\n i += 1\nnext\n",
       })
    compare_text(
        body + "print i\nsub square\n for i = 1 to 4\n print \"side\", i\n next\nend sub\n", 1);
}

/// Unreachable calls are removed, and with the last one the sub.
TEST(Agreement, CallsWhereNothingComes) {
  const std::string start = "input a, 5ms, 3\ninput b, 5ms, 1\n";
  const std::string end = "function f(p, q)\n return p + q\nend function\n";
  for (const std::string body : {
           "if a < b then\n print 5\n if a > b then\n print 6\n c = f(c, b)\n end if\nend if\n"
           "if 0 > 1 then print f(a, b)\n",
           "if 9 <= 0 then\n print f(a, b)\nelse\n if a * b = 3 then\n print 1\n"
           " if 3 < a * b then\n input c, 5ms, 9\n b = f(c, b)\n end if\n end if\nend if\n",
       })
    compare_text(start + body + end, 1);
}

/// A repeated call is dropped unless its inputs have changed: in the lines between, in the call
/// itself, in its arguments, or on one of two paths.
TEST(Agreement, CallsThatUseUpWhatTheyAreGiven) {
  const std::string start = "function sum(p, q)\n"
                            "  local v\n"
                            "  while p > 0\n"
                            "    v += p % q + k\n"
                            "    p /= q\n"
                            "  end while\n"
                            "  return v\n"
                            "end function\n"
                            "function noted(p)\n"
                            "  while p % 3 > 0\n"
                            "    p -= 1\n"
                            "  end while\n"
                            "  note = p + 5\n"
                            "  return p + 1\n"
                            "end function\n"
                            "input a, 5ms, 90\n"
                            "input b, 5ms, 7\n"
                            "input k, 5ms, 1\n"
                            "input note, 5ms, 11\n";
  for (const std::string body : {
           "print sum(a, b)\nprint sum(a, b)\n",
           "print sum(a, b)\na += 1\nprint sum(a, b)\n",
           "print sum(a, b)\nk += 1\nprint sum(a, b)\n",
           "print sum(a, b)\nif speed > 5 then b += 1\nprint sum(a, b)\n",
           "print sum(a, b)\nif speed > 5 then print sum(b, 2)\nprint sum(a, b)\n",
           "print sum(a, b)\nprint sum(b, a)\nprint sum(a, b)\nprint sum(a, b)\n",
           "p = a\nprint sum(p, b)\nprint sum(p, b), p\n",
           "repeat 3\nprint sum(a, b)\nprint sum(a, b)\na -= 9\nend repeat\n",
           "print noted(note)\nprint noted(note), note\n",
           "print noted(a)\ninput note, 5ms, 4\nprint noted(a), note\n",
       })
    compare_text(start + body, 1);
}

/// The result of a test decides the same test later, also with its sides exchanged, unless an
/// operand has changed between them, on one of two paths or in a call.
TEST(Agreement, TestsThatHaveBeenMade) {
  const std::string start = "input a, 5ms, 7\ninput b, 5ms, 9\n";
  const std::string end = "print a, b\nsub later\n  a += 2\nend sub\n";
  for (const std::string body : {
           "repeat\n n += 1\n if a <> b then\n print n\n delay 1ms\n a += 1\n end if\n"
           "until a = b or n = 5\nif a = b then print \"is\" else print \"not\"\n",
           "repeat\n n += 1\n input c, 5ms, 9\n if c <> b then print n\n"
           "until c = b or n = 5\nif c = b then print \"is\" else print \"not\"\n",
           "if a < b then print 1\nif speed > 5 then a += 2\nif b > a then print 2\n",
           "if a < b then print 1\nif b > a then print 2\nif a > b then print 3\n",
           "if a < b then\n print 1\n later\n if a < b then print 2 else print 3\nend if\n",
           "if a < b then\n print 1\n a += 2\n if b > a then print 2 else print 3\nend if\n",
           "if a <= b then\n print 1\n if a <> b then\n print 2\n if a < b then print 3\n"
           " end if\nend if\nif b < a then print 4\n",
           "for i = 1 to 3\n if a * a > b then print i\n a -= 3\n if a * a > b then print "
           "-i\nnext\n",
       })
    compare_text(start + body + end, 1);
}

TEST(Agreement, ProgramsThatHaveFoundSomething) {
  for (const std::uint64_t seed : {5472U, 10147U, 26301U, 181497U})
    compare(seed);
  for (const std::uint64_t seed : {99U, 26927U})
    compare(seed, Style::Short);
}

/// Compares the kept variables at the end with those of the tree evaluator, if it has them.
void compare_kept(std::uint64_t seed) {
  const auto text = testing::RandomStructured(seed).write();
  NoFiles files;
  const std::vector<std::string> kept{"alpha", "b", "count"};
  const auto compiled = compile("random.orb", "random.orb", text, {}, files, kept);
  if (compiled.robot.lines.empty() || any_error(compiled.program.diagnostics))
    return;
  SCOPED_TRACE("seed " + std::to_string(seed) + ":\n" + text + "\n" + compiled.robot.text);
  vm::NotebookHost plain_host;
  prepare(plain_host);
  TreeEvaluator plain(compiled.program, compiled.names, plain_host, seed);
  plain.run(4000);
  if (plain.end == "running")
    return;
  vm::NotebookHost host;
  prepare(host);
  vm::Machine machine(1'000'000, seed);
  run(machine, host, compiled.robot.text);
  ASSERT_EQ(host.printed, plain_host.printed);
  for (std::uint32_t s = 0; s < compiled.names.symbols.size(); ++s) {
    const auto name = std::string(compiled.program.name(compiled.names.symbols[s].name));
    if (compiled.names.symbols[s].kind != SymbolKind::Variable ||
        std::find(kept.begin(), kept.end(), name) == kept.end())
      continue;
    const auto letter = letter_of(compiled, name);
    ASSERT_TRUE(letter.has_value()) << name;
    ASSERT_EQ(machine.variable(*letter), plain.value_of(s)) << name;
  }
}

TEST(Agreement, KeptVariablesHoldTheirValues) {
  const auto programs = how_many() / 4;
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare_kept(seed);
}

TEST(Agreement, KeptVariablesHoldTheirValuesWhereAProgramStops) {
  compare_kept(2652);
}

/// A statement with an index error never completes.
TEST(Agreement, IndicesThatAreErrorsAreWrong) {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= how_many(); ++seed) {
    const auto text = testing::RandomStructured(seed).write();
    NoFiles files;
    const auto compiled = compile("random.orb", "random.orb", text, {}, files);
    bool only_indices = compiled.has_errors();
    for (const auto& found : compiled.program.diagnostics)
      only_indices =
          only_indices && (found.severity != Severity::Error || found.rule == &rules::ArrayIndex);
    if (!only_indices)
      continue;
    vm::NotebookHost host;
    prepare(host);
    TreeEvaluator plain(compiled.program, compiled.names, host, seed);
    plain.run(4000);
    for (const auto& found : compiled.program.diagnostics)
      for (std::uint32_t i = 0; i < compiled.program.statements.size(); ++i) {
        const auto& statement = compiled.program.statements[i];
        const bool simple = statement.kind == Kind::Assign || statement.kind == Kind::Print;
        if (found.rule != &rules::ArrayIndex || !simple ||
            found.span.begin < statement.span.begin || found.span.end > statement.span.end)
          continue;
        ++seen;
        ASSERT_FALSE(plain.done[i]) << "seed " << seed << ": " << in_english(found.message) << "\n"
                                    << text;
      }
  }
  EXPECT_GT(seen, 0U);
}

TEST(Agreement, MostRandomProgramsCompileAndRun) {
  // If all programs were refused, the test would prove nothing. The number depends on the C++
  // compiler.
  for (const auto style : {Style::Any, Style::Habits, Style::Short}) {
    int compiled_ones = 0;
    int ended = 0;
    for (std::uint64_t seed = 1; seed <= 450; ++seed) {
      const auto text = testing::RandomStructured(seed, style).write();
      NoFiles files;
      const auto compiled = compile("random.orb", "random.orb", text, {}, files);
      if (compiled.has_errors())
        continue;
      ++compiled_ones;
      vm::NotebookHost host;
      prepare(host);
      TreeEvaluator plain(compiled.program, compiled.names, host, seed);
      plain.run(4000);
      ended += plain.end == "end" ? 1 : 0;
    }
    EXPECT_GT(compiled_ones, 100);
    EXPECT_GT(ended, 50);
  }
}

} // namespace
} // namespace orb::structured
