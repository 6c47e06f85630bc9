#include "compiler/lint/sensor_tests.h"

#include "compiler/text/rules.h"

#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Relation;

SensorAnswer in_unit(const SensorQuestion& question, const spec::VariableInfo& row,
                     const spec::SmallUnit& unit) {
  const auto meant = question.written * unit.in_whole;
  const auto line = fmt::format("{} {} {}", row.word, question.symbol, meant);
  return {&rules::WrongUnit,
          fmt::format("`{}` counts in {}: {} {} is {}", row.word, unit.unit, question.written,
                      unit.whole, meant),
          fmt::format("write `{}`", line), line};
}

SensorAnswer passed(const SensorQuestion& question, const spec::VariableInfo& row, bool down) {
  const bool equal = question.relation == Relation::Equal;
  // Passed is below a timer that counts down and above one that counts up.
  const auto symbol = down == equal ? '<' : '>';
  const auto limit = equal ? question.number + (down ? 1 : -1) : question.number;
  const auto line = fmt::format("{} {} {}", row.word, symbol, limit);
  return {&rules::ExactTime,
          fmt::format("`{}` is {} for only one millisecond, so a loop can miss it", row.word,
                      question.number),
          fmt::format("write `{}`", line), line};
}

/// The answer of a comparison that has but one.
std::optional<bool> only_answer(const SensorQuestion& question, const spec::VariableInfo& row) {
  const bool below = question.number < row.least;
  const bool above = question.number > row.greatest;
  switch (question.relation) {
  case Relation::Equal: return below || above ? std::optional(false) : std::nullopt;
  case Relation::NotEqual: return below || above ? std::optional(true) : std::nullopt;
  case Relation::Less:
    if (question.number <= row.least)
      return false;
    return above ? std::optional(true) : std::nullopt;
  case Relation::Greater:
    if (question.number >= row.greatest)
      return false;
    return below ? std::optional(true) : std::nullopt;
  }
  return std::nullopt;
}

SensorAnswer constant(const SensorQuestion& question, const spec::VariableInfo& row, bool answer,
                      std::string_view text) {
  const auto unit = row.unit.empty() ? std::string() : fmt::format(" {}", row.unit);
  SensorAnswer said{&rules::ConstantComparison,
                    fmt::format("`{}` is {} true: `{}` is {} to {}{}", text,
                                answer ? "always" : "never", row.word, row.least, row.greatest,
                                unit),
                    "", ""};
  const bool turn = row.unit == "deg" && row.least == 0 && question.number == row.greatest + 1;
  if (turn && question.relation == Relation::Equal)
    said.line = fmt::format("{} = 0", row.word);
  said.help = turn && !said.line.empty()
                  ? fmt::format("write `{}`", said.line)
                  : fmt::format("compare with a number from {} to {}", row.least, row.greatest);
  return said;
}

} // namespace

std::optional<SensorAnswer> judge(const SensorQuestion& question, std::string_view text,
                                  const Timers& timers) {
  const auto& row = spec::info(question.sensor);
  const bool timer = is_timer(question.sensor);
  const bool exact =
      question.relation == Relation::Equal || question.relation == Relation::NotEqual;
  if (timer && exact && question.number > 0)
    return passed(question, row, timers.counts_down(question.sensor));
  const auto* unit = spec::find_small_unit(row.unit);
  const bool tiny = unit != nullptr && question.written > 1 && question.written < unit->least_meant;
  // A timer that counts down is below a few milliseconds when it has nearly passed.
  if (tiny &&
      (!timer || question.relation == Relation::Greater || !timers.counts_down(question.sensor)))
    return in_unit(question, row, *unit);
  if (const auto answer = only_answer(question, row))
    return constant(question, row, *answer, text);
  return std::nullopt;
}

} // namespace orb::compiler
