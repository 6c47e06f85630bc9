#include "run/why.h"

#include "compiler/analyse/reading.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/text/rules.h"
#include "run/start.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace orb::run {
namespace {

namespace rules = compiler::rules;
using compiler::ItemKind;
using spec::Statement;

/// A ball that was told to roll and came no farther than this did not do what was intended.
constexpr std::uint64_t hardly_cm = 5;

/// The rules that can explain an ending, most likely first.
std::vector<const Rule*> suspects(const Ending& ending) {
  const auto& sight = ending.sight;
  if (ending.reason == Reason::TimeLimit)
    return {&rules::StaleSensor, &rules::ExactTime, &rules::ConstantComparison, &rules::WrongUnit,
            &rules::LoopVariableSet};
  if (ending.reason != Reason::End)
    return {};
  if (sight.told_to_move && sight.way_cm < hardly_cm)
    return {&rules::WrongUnit,    &rules::TinyValue,    &rules::GoZero,
            &rules::MissingDelay, &rules::InvertedWait, &rules::DrivesOn};
  return {&rules::WrongUnit, &rules::MissingDelay, &rules::InvertedWait,
          &rules::TinyValue, &rules::DrivesOn,     &rules::WeakBrake};
}

std::string sentence(const std::string& where, const std::string& seen, const std::string& help) {
  return fmt::format("{}: {}{}{}", where, seen, help.empty() ? "" : "; ", help);
}

/// Returns the first finding of one of the rules; null if there is none.
const Diagnostic* find(std::span<const Diagnostic> findings, std::span<const Rule* const> wanted) {
  for (const auto* rule : wanted) {
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Diagnostic& one) {
      // Of colour findings only those about a replaced colour: the last one is visible at the end
      // of the run.
      return one.rule == rule && (rule != &rules::MissingDelay || !one.notes.empty());
    });
    if (found != findings.end())
      return &*found;
  }
  return nullptr;
}

std::string from_linter(const Input& input, const Ending& ending) {
  const auto wanted = suspects(ending);
  if (wanted.empty())
    return {};
  const auto* found = find(findings(input).front().diagnostics, wanted);
  if (found == nullptr)
    return {};
  const auto place = input.source->position(found->span.begin);
  const auto where = found->basic_line
                         ? fmt::format("line {}", *found->basic_line)
                         : fmt::format("{}:{}:{}", input.source->name(), place.line, place.column);
  return sentence(where, in_english(found->message), in_english(found->help));
}

/// Describes a macro that the program starts by number and that was not supplied.
std::string missing_macro(const Program& program, const Load& load) {
  const auto& parsed = program.parsed;
  for (const auto& line : parsed.lines) {
    if (!line.has_statement())
      continue;
    for (const auto& statement : parsed.whole(parsed.statements[line.statement])) {
      if (statement.error || statement.kind != Statement::Macrun)
        continue;
      const auto id = compiler::number_in(parsed, parsed.items_of(statement)[0]);
      const bool there = !id || std::any_of(load.macros.begin(), load.macros.end(),
                                            [&](const Macro* one) { return one->image.id == *id; });
      if (!there)
        return sentence(program.where(line.number),
                        fmt::format("there is no macro {} on the ball", *id),
                        fmt::format("add the file that defines it, with `.macro NAME id={}`", *id));
    }
  }
  return {};
}

bool sets(const compiler::Program& parsed, spec::Variable timer) {
  return std::any_of(parsed.statements.begin(), parsed.statements.end(), [&](const auto& one) {
    if (one.error || one.kind != Statement::Let)
      return false;
    const auto& variable = parsed.as<compiler::LetView>(one).variable;
    return variable.kind == ItemKind::System && variable.value == static_cast<std::uint32_t>(timer);
  });
}

/// Returns true if a line jumps to itself while its comparison holds.
bool waits(const compiler::Program& parsed, const compiler::Line& line) {
  const auto& statement = parsed.statements[line.statement];
  if (statement.error || statement.kind != Statement::If)
    return false;
  const auto& branch = parsed.statements[statement.then_branch];
  return !branch.error && branch.kind == Statement::Goto &&
         parsed.items_of(branch)[0].value == line.number;
}

/// Describes a line that waits for a timer which is never set.
std::string unset_timer(const Program& program) {
  const auto& parsed = program.parsed;
  for (const auto& line : parsed.lines) {
    if (!line.has_statement() || !waits(parsed, line))
      continue;
    const auto condition = parsed.as<compiler::IfView>(parsed.statements[line.statement]);
    const auto test = compiler::sensor_test(parsed, condition.first);
    if (!test || !compiler::is_timer(test->sensor) || sets(parsed, test->sensor))
      continue;
    const auto word = spec::info(test->sensor).word;
    return sentence(
        program.where(line.number),
        fmt::format("this waits for `{}`, but nothing sets the timer, so it counts up", word),
        fmt::format("above it, write `{} = 1000`", word));
  }
  return {};
}

} // namespace

std::string why(std::span<const Input> inputs, const Ending& ending) {
  const auto* input = first_with_program(inputs);
  if (input == nullptr)
    return {};
  if (ending.reason == Reason::TimeLimit)
    if (auto timer = unset_timer(*input->program); !timer.empty())
      return timer;
  if (ending.reason == Reason::End)
    if (auto macro = missing_macro(*input->program, load_of(inputs)); !macro.empty())
      return macro;
  return from_linter(*input, ending);
}

} // namespace orb::run
