#include "compiler/lint/sensor_tests.h"

#include "compiler/analyse/range.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"

#include <fmt/format.h>

namespace orb::compiler {
namespace {

SensorAnswer in_unit(const SensorQuestion& question, const spec::VariableInfo& row,
                     const spec::SmallUnit& unit) {
  const auto meant = question.number * unit.in_whole;
  const auto line =
      fmt::format("{} {} {}", row.word, sign_of(question.orders, question.unequal), meant);
  return {&rules::WrongUnit,
          texts::CountsIn(row.word, unit.unit, fmt::format("{} {}", question.number, unit.whole),
                          meant),
          texts::Write(line), line};
}

SensorAnswer passed(const SensorQuestion& question, const spec::VariableInfo& row, bool down) {
  const bool equal = question.orders == Orders::Equal;
  // A timer that counts down passes to below the number, one that counts up to above.
  const auto symbol = down == equal ? '<' : '>';
  const auto limit = equal ? question.number + (down ? 1 : -1) : question.number;
  const auto line = fmt::format("{} {} {}", row.word, symbol, limit);
  return {&rules::ExactTime, texts::ForOneMillisecond(row.word, question.number),
          texts::Write(line), line};
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
  if (turn && question.orders == Orders::Equal)
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
  const bool exact = question.orders == Orders::Equal || question.orders == Orders::NotEqual;
  if (timer && exact && question.number > 0)
    return passed(question, row, timers.counts_down(question.sensor));
  const auto* unit = spec::find_small_unit(row.unit);
  const bool tiny = unit != nullptr && !question.has_unit && question.number > 1 &&
                    question.number < unit->least_meant;
  // A timer that counts down is below a few milliseconds when it has almost run out.
  if (tiny &&
      (!timer || !has(question.orders, Orders::Less) || !timers.counts_down(question.sensor)))
    return in_unit(question, row, *unit);
  if (const auto answer =
          answer_of(question.orders, {row.least, row.greatest}, Range::only(question.number)))
    return constant(question, row, *answer, text);
  return std::nullopt;
}

} // namespace orb::compiler
