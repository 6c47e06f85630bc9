#include "structured/emit/findings.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "repair/tokens.h"
#include "spec/limits.h"
#include "structured/text/link_blocks.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::structured {
namespace {

namespace robot = compiler::rules;
namespace robot_texts = compiler::texts;

/// The rules that also apply to structured programs; structured/meaning/ covers the subjects of the
/// others, such as sensors compared with a written number.
bool is_told(const Diagnostic& found, std::string_view text) {
  for (const auto* told : {&robot::ValueOutOfRange,  &robot::DivisionByZero,  &robot::UnknownFlags,
                           &robot::MissingGo,        &robot::NewerThanTarget, &robot::ReadPastData,
                           &robot::ClearedByReading, &robot::DataReplaced,    &robot::BusyLoop,
                           &robot::IndexRange,       &robot::MissingDelay,    &robot::DrivesOn,
                           &robot::LoopLeavesRange,  &robot::HeadingGrows,    &robot::ValueGrows,
                           &robot::MayLeaveRange,    &robot::WrongUnit,       &robot::TinyValue,
                           &robot::GoZero,           &robot::WeakBrake,       &robot::StaleSensor,
                           &robot::InvertedWait,     &robot::LoopVariableSet, &robot::EmptyLoop,
                           &robot::AlwaysOne,        &robot::RobotLacks,      &robot::NeverRolls,
                           &robot::WakesElsewhere,   &robot::LostExchange,    &robot::DividesFirst,
                           &robot::StaysZero,        &robot::SumRestarts,     &robot::EndlessLoop,
                           &robot::EarlySensor,      &robot::ExtraTurn,       &robot::LostUpdate})
    if (found.rule == told)
      return true;
  const auto& message = found.message; // their other texts are about orbBasic only
  return message.is(robot_texts::NoRollLeadsThere) || message.is(robot_texts::NeverLess) ||
         message.is(robot_texts::NeverMore) || message.is(robot_texts::EndsAfterOne) ||
         message.is(robot_texts::NeverTrueBelow) ||
         ((message.is(robot_texts::AsSensorIs) || message.is(robot_texts::AsSensorIsIn)) &&
          is_letter(trim(text.substr(text.find_last_of("<>=!") + 1)).front()));
}

class MeaningFindings {
public:
  MeaningFindings(Program& program, const Names& names, const compiler::Program& lines)
      : program_(program), names_(names), lines_(lines) {}

  void run(const compiler::Target& target) {
    for (auto& found : compiler::lint_meaning(lines_, target))
      if (is_told(found, program_.text_of(found.span)))
        tell(std::move(found));
  }

private:
  const Statement& statement_at(std::uint32_t offset) const {
    const auto next = std::upper_bound(
        program_.statements.begin(), program_.statements.end(), offset,
        [](std::uint32_t at, const Statement& one) { return at < one.span.begin; });
    return next == program_.statements.begin() ? *next : *(next - 1);
  }

  void tell(Diagnostic found) {
    const auto& statement = statement_at(found.span.begin);
    if (has_unit(found) || (is_error(found) && raise_what_was_feared(statement)) ||
        is_said(found, statement))
      return;
    if (found.fix && !std::all_of(found.fix->edits.begin(), found.fix->edits.end(),
                                  [&](const Edit& edit) { return is_typed(edit.span); }))
      found.fix.reset();
    put_into_source_words(found, statement);
    std::erase_if(found.notes, [&](const Note& note) {
      return &statement_at(note.span.begin) == &statement || is_of_test(note);
    });
    program_.diagnostics.push_back(std::move(found));
  }

  /// Raises a possible fault, reported earlier, to an error because it is certain; returns true if
  /// there was one.
  bool raise_what_was_feared(const Statement& statement) {
    for (auto& other : program_.diagnostics)
      if (other.span.begin >= statement.span.begin && other.span.end <= statement.span.end &&
          other.rule == &robot::LoopLeavesRange) {
        other.severity = Severity::Error;
        return true;
      }
    return false;
  }

  /// True if the span is a literal number, which may be replaced.
  bool is_typed(Span span) const {
    return span.size() == 0 || is_digit(program_.text[span.begin]) ||
           program_.text[span.begin] == '-';
  }

  /// True if a time has an explicit unit and is therefore intended.
  bool has_unit(const Diagnostic& found) const {
    const auto text = program_.text_of(found.span);
    return found.rule == &robot::WrongUnit && is_digit(text.front()) && is_letter(text.back());
  }

  /// True for notes about tests: lowering inverts tests, so these do not match the source.
  static bool is_of_test(const Note& note) {
    return note.message.is(robot_texts::WhenThisHolds) ||
           note.message.is(robot_texts::WhenThisDoesNotHold);
  }

  /// True if the same or a more severe finding is already reported for the statement.
  bool is_said(const Diagnostic& found, const Statement& statement) const {
    return std::any_of(
        program_.diagnostics.begin(), program_.diagnostics.end(), [&](const Diagnostic& other) {
          return other.span.begin >= statement.span.begin && other.span.end <= statement.span.end &&
                 (other.rule == found.rule || other.severity == Severity::Error ||
                  (is_of_array(found) && other.rule == &robot::LoopLeavesRange) ||
                  found.rule == &robot::WrongUnit);
        });
  }

  /// True if it is about an index of the robot's only list.
  static bool is_of_array(const Diagnostic& found) {
    return found.message.is(robot_texts::UsedWhileIndexIs) ||
           found.message.is(robot_texts::UsedWhileIndexCanBe) ||
           found.message.is(robot_texts::UsedWhileIndexBecomes);
  }

  /// Replaces letters and line numbers of the robot by terms of the source.
  void put_into_source_words(Diagnostic& found, const Statement& statement) const {
    if (found.rule == &robot::BusyLoop)
      found.message = texts::NeverWaits();
    if (found.rule == &robot::WakesElsewhere)
      found.message = texts::RestartInFlash();
    if (is_of_array(found))
      tell_of_index(found, statement);
    if (found.rule == &robot::HeadingGrows || found.rule == &robot::ValueGrows)
      tell_of_sum(found, statement);
    if (found.rule == &robot::StaleSensor)
      tell_of_copy(found, statement);
    if (found.rule == &robot::DrivesOn)
      tell_of_stop(found, statement);
    if (found.rule == &robot::InvertedWait) {
      found.help = texts::Reverse();
      found.fix.reset();
    }
  }

  /// The arrays that a statement uses, each once.
  std::vector<const Symbol*> arrays_of(const Statement& statement) const {
    std::vector<const Symbol*> arrays;
    for (const auto& item : program_.items_of(statement)) {
      if (!item.has_nodes())
        continue;
      for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
        const auto symbol = names_.of_node[n];
        if (program_.nodes[n].kind != NodeKind::Element || symbol == none)
          continue;
        const auto* array = &names_.symbols[symbol];
        if (std::find(arrays.begin(), arrays.end(), array) == arrays.end())
          arrays.push_back(array);
      }
    }
    return arrays;
  }

  /// Rewords a finding about an index to name the array of the source.
  void tell_of_index(Diagnostic& found, const Statement& statement) const {
    const auto arrays = arrays_of(statement);
    found.help = {};
    found.fix.reset();
    found.span = statement.span;
    found.message = is_error(found) ? texts::IndexOutOfBounds()
                    : arrays.size() == 1
                        ? texts::IndexCanLeave(program_.name(arrays[0]->name), arrays[0]->value)
                        : texts::AnIndexCanLeave();
  }

  /// Explains that a loop must read the sensor itself instead of a copy.
  void tell_of_copy(Diagnostic& found, const Statement& statement) const {
    found.help = texts::ReadInLoop();
    if (found.notes.empty() || statement.kind != Kind::Assign)
      return;
    const auto items = program_.items_of(statement);
    const auto name = program_.text_of(items[0].span);
    const auto test = std::string(program_.text_of(statement_at(found.notes[0].span.begin).span));
    for (const auto& token : repair::tokens_of(test, repair::Language::Structured))
      if (token.is_word() && equal_words(token.text, name))
        found.help = robot_texts::WriteInLoop(fmt::format("{}{}{}", test.substr(0, token.at),
                                                          program_.text_of(items[1].span),
                                                          test.substr(token.at + name.size())));
  }

  /// The only `delay` between a roll and the last statement, if no block intervenes; else the last
  /// statement.
  const Statement* only_wait_below(const Statement& roll, const Statement& last) const {
    const Statement* found = nullptr;
    for (const auto* one = &roll + 1; one <= &last; ++one) {
      const bool waits = one->kind == Kind::Robot && one->robot == spec::Statement::Delay;
      if (one->depth != roll.depth || opens_block(one->kind) || one->kind == Kind::Label ||
          (waits && found != nullptr))
        return &last;
      found = waits ? one : found;
    }
    return found != nullptr ? found : &last;
  }

  /// Proposes a line that stops the ball in its rolling direction.
  void tell_of_stop(Diagnostic& found, const Statement& statement) const {
    std::string_view heading = "0";
    const auto* place = &statement;
    found.fix.reset();
    for (const auto& note : found.notes)
      if (const auto& roll = statement_at(note.span.begin);
          roll.kind == Kind::Robot && roll.robot == spec::Statement::Goroll) {
        const auto first = program_.text_of(program_.items_of(roll)[0].span);
        heading = is_digit(first[0]) ? first : heading;
        place = only_wait_below(roll, statement);
      }
    auto line = fmt::format("goroll {}, 0, 0", heading);
    const std::string end(line_end_of(program_.text));
    const bool waits = // somewhere; otherwise the linter adds a wait, too
        std::any_of(lines_.statements.begin(), lines_.statements.end(), [](const auto& one) {
          return spec::info(one.kind).after == spec::After::Waits;
        });
    const auto& last = *place;
    const bool ends = last.kind == Kind::Robot && last.robot == spec::Statement::End;
    if (!waits) {
      found.help = texts::AddTwo("delay 1s", line);
      line = "delay 1s" + end + line;
    } else if (&last != &statement) {
      found.help = texts::AddBelowOther(line, program_.text_of(last.span));
    } else {
      found.help = (ends ? texts::AddAbove : texts::AddBelow)(line);
    }
    if (last.depth > 0 || last.one_line)
      return;
    const auto begin = last.span.begin;
    const auto rest = program_.text.find_first_of("\r\n", last.span.end);
    const auto at = static_cast<std::uint32_t>(std::min(rest, program_.text.size()));
    found.fix = Fix{found.help,
                    {ends ? Edit{{begin, begin}, line + end} : Edit{{at, at}, end + line}},
                    Safety::Unsafe};
  }

  /// The amount subtracted by the assignment whose sum is at `span`; 0 if it adds.
  std::int32_t taken_away(Span span) const {
    const auto sum =
        std::find_if(lines_.items.begin(), lines_.items.end(), [&](const compiler::Item& one) {
          return one.kind == compiler::ItemKind::Expression && one.span == span;
        });
    if (sum == lines_.items.end())
      return 0;
    const auto& root = lines_.nodes[sum->value];
    const bool subtracts = root.kind == compiler::NodeKind::Binary &&
                           static_cast<spec::Operator>(root.what) == spec::Operator::Subtract;
    return subtracts ? lines_.nodes[sum->value - 1].value : 0;
  }

  /// The limit, named last in a message.
  static std::int32_t limit_in(const Message& message) {
    return static_cast<std::int32_t>(std::stol(message.fillers().back().words()));
  }

  void tell_of_sum(Diagnostic& found, const Statement& statement) const {
    if (statement.kind != Kind::Assign)
      return;
    const auto items = program_.items_of(statement);
    const auto name = program_.text_of(items[0].span);
    auto sum = std::string(program_.text_of(items[1].span));
    if (statement.operation != Statement::none_operation)
      sum = fmt::format("{} {} {}", name,
                        spec::info(static_cast<spec::Operator>(statement.operation)).symbol,
                        sum.find(' ') == std::string::npos ? sum : fmt::format("({})", sum));
    // The remainder of a negative value is negative, so add a turn first.
    const auto turn = found.rule == &robot::HeadingGrows
                          ? spec::info(spec::Statement::Goroll).parameters()[0].greatest + 1
                          : limit_in(found.message) + 1;
    if (const auto step = taken_away(found.span); step > 0)
      sum = fmt::format("{} + {}", name, turn - step % turn);
    found.span = statement.span;
    found.message.refill(0, Message::as_is(std::string(name)));
    const auto line = fmt::format("{} = ({}) % {}", name, sum, turn);
    found.help = texts::Write(line);
    found.fix = single_fix(found.help, statement.span, line, Safety::Unsafe);
  }

  Program& program_;
  const Names& names_;
  const compiler::Program& lines_;
};

} // namespace

void find_meaning(Program& program, const Names& names, const compiler::Program& lines,
                  const compiler::Target& target) {
  MeaningFindings(program, names, lines).run(target);
}

} // namespace orb::structured
