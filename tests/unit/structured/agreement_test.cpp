#include "base/random.h"
#include "compiler/check.h"
#include "compiler/rules.h"
#include "random_structured.h"
#include "structured/compile.h"
#include "structured/rules.h"
#include "tree_evaluator.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace orb::structured {
namespace {

/// How many programs: ORB_PROGRAMS, which ./dev fuzz sets, or enough for a second or two.
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
            std::string(compiled.program.text_of(found.span)) + "`: " + found.message + "\n";
  return text;
}

/// The rules that may be raised on the robot's lines: what the source says itself.
bool may_remain(const Diagnostic& found) {
  namespace robot = compiler::rules;
  for (const auto* rule : {&robot::BusyLoop, &robot::ClearedByReading, &robot::DataReplaced,
                           &robot::DataExpression, &robot::LargerThanOldRam, &robot::UnusedVariable,
                           &robot::MissingGo, &robot::ProgramTooLarge, &robot::MissingDelay,
                           &robot::DrivesOn, &robot::LoopLeavesRange, &robot::HeadingGrows})
    if (found.rule == rule)
      return true;
  return found.severity == Severity::Info;
}

void compare(std::uint64_t seed) {
  const auto text = testing::RandomStructured(seed).write();
  NoFiles files;
  compiler::Target target;
  target.ram_bytes = 4096;
  const auto compiled = compile("random.orb", "random.orb", text, target, files);
  SCOPED_TRACE("seed " + std::to_string(seed) + ":\n" + text + "\n" + compiled.robot.text +
               all_findings(compiled));
  for (const auto& found : compiled.program.diagnostics)
    if (found.severity == Severity::Error) {
      // Constants that are wrong for certain, and programs that do not fit, are refused.
      ASSERT_NE(found.rule, &rules::MalformedLine);
      ASSERT_NE(found.rule, &rules::UnknownName);
    }
  if (compiled.robot.lines.empty() || compiled.has_errors())
    return;

  const auto checked = compiler::check(compiled.robot.text, target);
  for (const auto& found : checked.diagnostics)
    ASSERT_TRUE(may_remain(found)) << found.rule->id << ": " << found.message;

  vm::NotebookHost plain_host;
  prepare(plain_host);
  TreeEvaluator plain(compiled.program, compiled.names, plain_host, seed);
  plain.run(4000);

  vm::NotebookHost host;
  prepare(host);
  vm::Machine machine(1'000'000, seed);
  auto chunk = compiler::load(compiled.robot.text);
  machine.start(std::move(chunk), 1, Instant{});
  while (machine.running() && machine.next_event() != never && machine.lines() < 40000)
    machine.run(std::max(machine.next_event(), machine.now()) + 10ms, host);

  std::erase_if(host.notes, [](const std::string& note) { return note.starts_with("delay"); });
  if (plain.end == "running") {
    const auto printed = std::min(plain_host.printed.size(), host.printed.size());
    ASSERT_TRUE(host.printed.substr(0, printed) == plain_host.printed.substr(0, printed));
    return;
  }
  constexpr std::size_t shown = 400; // of what an endless loop printed
  ASSERT_EQ(host.printed.substr(0, shown), plain_host.printed.substr(0, shown));
  ASSERT_TRUE(host.printed == plain_host.printed);
  ASSERT_TRUE(host.notes == plain_host.notes);
  const auto stop = machine.take_stop();
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

TEST(Agreement, CompiledProgramsDoWhatTheTextSays) {
  const auto programs = how_many();
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed)
    compare(seed);
}

TEST(Agreement, ProgramsThatHaveFoundSomething) {
  for (const std::uint64_t seed : {5472, 10147})
    compare(seed);
}

TEST(Agreement, MostRandomProgramsCompileAndRun) {
  // Programs that are all refused would prove nothing.
  int compiled_ones = 0;
  int ended = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto text = testing::RandomStructured(seed).write();
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

} // namespace
} // namespace orb::structured
