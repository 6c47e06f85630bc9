#include "compiler/lint/sensor_tests.h"

#include "compiler/text/rules.h"
#include "compiler/text/texts.h"

#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Relation;

SensorAnswer in_unit(const SensorQuestion& question, const spec::VariableInfo& row,
                     const spec::SmallUnit& unit) {
  const auto meant = question.written * unit.in_whole;
  const auto line = fmt::format("{} {} {}", row.word, question.symbol, meant);
  return {&rules::WrongUnit,
          texts::CountsIn(row.word, unit.unit, fmt::format("{} {}", question.written, unit.whole),
                          meant),
          texts::Write(line), line};
}

SensorAnswer passed(const SensorQuestion& question, const spec::VariableInfo& row, bool down) {
  const bool equal = question.relation == Relation::Equal;
  // A timer that counts down passes to below the number, one that counts up to above.
  const auto symbol = down == equal ? '<' : '>';
  const auto limit = equal ? question.number + (down ? 1 : -1) : question.number;
  const auto line = fmt::format("{} {} {}", row.word, symbol, limit);
  return {&rules::ExactTime, texts::ForOneMillisecond(row.word, question.number),
          texts::Write(line), line};
}

/// The result of a comparison that is constant; nothing otherwise.
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
  const auto result = answer ? texts::AlwaysTrue(text) : texts::NeverTrue(text);
  SensorAnswer said{&rules::ConstantComparison,
                    row.unit.empty()
                        ? texts::AsSensorIs(result, row.word, row.least, row.greatest)
                        : texts::AsSensorIsIn(result, row.word, row.least, row.greatest, row.unit),
                    {},
                    {}};
  const bool turn = row.unit == "deg" && row.least == 0 && question.number == row.greatest + 1;
  if (turn && question.relation == Relation::Equal)
    said.line = fmt::format("{} = 0", row.word);
  said.help = turn && !said.line.empty() ? texts::Write(said.line)
                                         : texts::CompareWithFromTo(row.least, row.greatest);
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
  // A timer that counts down is below a few milliseconds when it has almost run out.
  if (tiny &&
      (!timer || question.relation == Relation::Greater || !timers.counts_down(question.sensor)))
    return in_unit(question, row, *unit);
  if (const auto answer = only_answer(question, row))
    return constant(question, row, *answer, text);
  return std::nullopt;
}

} // namespace orb::compiler
