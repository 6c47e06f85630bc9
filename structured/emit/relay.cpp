#include "structured/emit/relay.h"

#include "base/text/text.h"
#include "compiler/text/image.h"
#include "compiler/text/parse.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "repair/tokens.h"
#include "spec/limits.h"
#include "structured/text/blocks.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace orb::structured {
namespace {

namespace robot = compiler::rules;
namespace robot_texts = compiler::texts;

/// The rules whose findings say something about the source, in words that fit it.
bool is_told(const Rule* rule) {
  for (const auto* told : {&robot::ValueOutOfRange,  &robot::DivisionByZero,  &robot::UnknownFlags,
                           &robot::MissingGo,        &robot::NewerThanTarget, &robot::ReadPastData,
                           &robot::ClearedByReading, &robot::DataReplaced,    &robot::BusyLoop,
                           &robot::IndexRange,       &robot::NonprintingByte, &robot::MissingDelay,
                           &robot::DrivesOn,         &robot::LoopLeavesRange, &robot::HeadingGrows,
                           &robot::MayLeaveRange,    &robot::WrongUnit,       &robot::TinyValue,
                           &robot::GoZero,           &robot::WeakBrake,       &robot::StaleSensor,
                           &robot::InvertedWait,     &robot::LoopVariableSet, &robot::EmptyLoop,
                           &robot::AlwaysOne,        &robot::RobotLacks,      &robot::NeverRolls,
                           &robot::WakesElsewhere})
    if (rule == told)
      return true;
  return false;
}

class Relay {
public:
  Relay(Compiled& compiled, const compiler::Target& target)
      : compiled_(compiled), target_(target), plain_(compiler::parse(compiled.robot.text)) {}

  void run() {
    compiled_.image = compiler::build_image(plain_, compiler::Packing::Packed);
    for (const auto& found : compiler::lint(plain_, target_))
      if (is_told(found.rule))
        tell(found);
    check_size(compiled_.image);
    compiled_.lines = std::move(plain_);
  }

private:
  /// Whether it is about an index of the robot's only list.
  bool is_of_array(const Diagnostic& found) const {
    return found.rule == &robot::MayLeaveRange && plain_.text_of(found.span) == "Z";
  }

  /// The arrays that a statement uses, each once.
  std::vector<const Symbol*> arrays_of(const Statement& statement) const {
    std::vector<const Symbol*> arrays;
    for (const auto& item : compiled_.program.items_of(statement)) {
      if (!item.has_nodes())
        continue;
      for (auto n = compiled_.program.nodes[item.value].first; n <= item.value; ++n) {
        const auto symbol = compiled_.names.of_node[n];
        if (compiled_.program.nodes[n].kind != NodeKind::Element || symbol == none)
          continue;
        const auto* array = &compiled_.names.symbols[symbol];
        if (std::find(arrays.begin(), arrays.end(), array) == arrays.end())
          arrays.push_back(array);
      }
    }
    return arrays;
  }

  /// An index, in words of the array that the source has.
  void tell_of_index(const Statement& statement, Diagnostic& told) const {
    const auto arrays = arrays_of(statement);
    told.help = {};
    told.message =
        arrays.size() == 1
            ? texts::IndexCanLeave(compiled_.program.name(arrays[0]->name), arrays[0]->value)
            : texts::AnIndexCanLeave();
  }

  /// Whether a statement was written to several places that use an element: an index that is wrong
  /// in one of them is right somewhere.
  bool has_copies(std::uint32_t statement) const {
    return std::count_if(compiled_.robot.lines.begin(), compiled_.robot.lines.end(),
                         [&](const RobotLine& line) {
                           return line.statement == statement && uses_element(line.number);
                         }) > 1;
  }

  bool uses_element(std::uint32_t number) const {
    const auto line = std::find_if(plain_.lines.begin(), plain_.lines.end(),
                                   [&](const auto& one) { return one.number == number; });
    return line != plain_.lines.end() &&
           plain_.text_of(line->span).find('Z') != std::string_view::npos;
  }

  std::size_t line_at(std::uint32_t offset) const {
    const auto& lines = compiled_.robot.lines;
    const auto next =
        std::upper_bound(lines.begin(), lines.end(), offset,
                         [](std::uint32_t at, const RobotLine& line) { return at < line.offset; });
    return static_cast<std::size_t>(next - lines.begin()) - 1;
  }

  const Statement& statement_at(std::uint32_t offset) const {
    return compiled_.program.statements[compiled_.robot.lines[line_at(offset)].statement];
  }

  /// The argument of the source that a value of the robot's line was written for, or null.
  const Item* argument_of(Span value, const Statement& statement) const {
    const auto items = compiled_.program.items_of(statement);
    for (const auto& plain : plain_.statements) {
      const auto values = plain_.items_of(plain);
      if (statement.kind != Kind::Robot || plain.kind != statement.robot ||
          values.size() != items.size())
        continue;
      for (std::size_t n = 0; n < items.size(); ++n)
        if (values[n].span == value)
          return &items[n];
    }
    return nullptr;
  }

  /// What happens for certain there was already said to be possible, in words of the source:
  /// whether that became an error.
  bool raise_what_was_feared(const Diagnostic& found, const Statement& statement) {
    if (found.rule == &robot::IndexRange &&
        has_copies(compiled_.robot.lines[line_at(found.span.begin)].statement))
      return false;
    for (auto& other : compiled_.program.diagnostics)
      if (other.span.begin >= statement.span.begin && other.span.end <= statement.span.end &&
          (other.rule == &robot::LoopLeavesRange || other.rule == &robot::MayLeaveRange)) {
        other.severity = Severity::Error;
        return true;
      }
    return false;
  }

  void tell(const Diagnostic& found) {
    auto& program = compiled_.program;
    const auto& statement = statement_at(found.span.begin);
    const auto* argument = argument_of(found.span, statement);
    if (found.rule == &robot::WrongUnit && argument != nullptr) {
      const auto text = program.text_of(argument->span);
      if (is_digit(text.front()) && is_letter(text.back()))
        return; // it has its unit
    }
    if (is_error(found) && raise_what_was_feared(found, statement))
      return;
    const bool said = std::any_of(
        program.diagnostics.begin(), program.diagnostics.end(), [&](const Diagnostic& other) {
          return other.span.begin >= statement.span.begin && other.span.end <= statement.span.end &&
                 (other.rule == found.rule || other.severity == Severity::Error ||
                  (is_of_array(found) && other.rule == &robot::LoopLeavesRange) ||
                  found.rule == &robot::WrongUnit);
        });
    if (said)
      return;
    Diagnostic told = finding(*found.rule, argument != nullptr ? argument->span : statement.span,
                              found.message, found.help);
    told.severity = found.severity;
    if (found.rule == &robot::IndexRange &&
        has_copies(compiled_.robot.lines[line_at(found.span.begin)].statement))
      told.severity = Severity::Warning;
    for (const auto& note : found.notes)
      if (const auto& there = statement_at(note.span.begin);
          &there != &statement && !is_of_test(note.message))
        told.notes.push_back({there.span, note.message});
    put_into_source_words(found, statement, told);
    program.diagnostics.push_back(std::move(told));
  }

  /// Whether it says how a test of the robot turns out, which may be the reverse of the source's.
  static bool is_of_test(const Message& message) {
    return message.is(robot_texts::WhenThisHolds) || message.is(robot_texts::WhenThisDoesNotHold);
  }

  /// Letters and line numbers of the robot say nothing to whoever wrote names.
  void put_into_source_words(const Diagnostic& found, const Statement& statement,
                             Diagnostic& told) const {
    const auto& program = compiled_.program;
    if (found.rule == &robot::BusyLoop)
      told.message = texts::NeverWaits();
    if (found.rule == &robot::IndexRange)
      told.message = texts::IndexOutOfBounds();
    if (found.message.is(robot_texts::DividesByZeroHere) ||
        found.message.is(robot_texts::DividesByZeroInRound))
      told.message = robot_texts::DividesByZero();
    if (is_of_array(found))
      return tell_of_index(statement, told);
    if (found.rule == &robot::WakesElsewhere)
      told.message = texts::RestartInFlash();
    if (found.rule == &robot::HeadingGrows && statement.kind == Kind::Assign)
      tell_of_heading(found, statement, told);
    if (found.rule == &robot::StaleSensor)
      tell_of_copy(found, statement, told);
    if (found.rule == &robot::ValueOutOfRange && found.fix && found.fix->edits.size() > 1 &&
        !std::all_of(found.fix->edits.begin(), found.fix->edits.end(), [&](const Edit& edit) {
          const auto* argument = argument_of(edit.span, statement);
          return argument != nullptr && is_digit(program.text_of(argument->span)[0]);
        }))
      told.help = {}; // what is exchanged there are names
    if (found.rule == &robot::DrivesOn)
      tell_of_stop(found, statement, told);
    if (found.rule == &robot::InvertedWait)
      told.help = texts::Reverse();
    if (found.fix && found.fix->edits.size() == 1 && found.rule != &robot::ValueOutOfRange)
      put_fix_into_source(*found.fix, statement, told);
    if (found.rule == &robot::LoopLeavesRange || found.rule == &robot::MayLeaveRange)
      tell_of_value(found, statement, told);
  }

  /// A value, as the source writes it. Of one that is no argument of the source only the number is
  /// told.
  void tell_of_value(const Diagnostic& found, const Statement& statement, Diagnostic& told) const {
    if (told.span == statement.span && (found.message.is(robot_texts::ButBecomes) ||
                                        found.message.is(robot_texts::ButBecomesInRound)))
      told.message =
          robot_texts::FoundValue(found.message.fillers()[0], found.message.fillers()[2]);
    const std::string letters(plain_.text_of(found.span));
    const std::string names(compiled_.program.text_of(told.span));
    const auto grouped = fmt::format("({})", names);
    const bool joins = letters.size() == 1 && !told.help.is(robot_texts::WriteTurned) &&
                       names.find_first_of(" +-*/%&|{}") != names.npos;
    rename(told.message, letters, names);
    rename(told.help, fmt::format("({})", letters), grouped);
    rename(told.help, letters, joins ? grouped : names);
  }

  /// Puts `to` into the first hole that holds `from`.
  static void rename(Message& message, std::string_view from, std::string_view to) {
    const auto& holes = message.fillers();
    const auto hole = std::find_if(holes.begin(), holes.end(),
                                   [&](const Message& one) { return one.words() == from; });
    if (hole != holes.end())
      message.refill(static_cast<std::size_t>(hole - holes.begin()),
                     Message::as_is(std::string(to)));
  }

  /// A copy of a sensor: the loop is to read the sensor itself.
  void tell_of_copy(const Diagnostic& found, const Statement& statement, Diagnostic& told) const {
    const auto& program = compiled_.program;
    told.help = texts::ReadInLoop();
    if (found.notes.empty() || statement.kind != Kind::Assign)
      return;
    const auto items = program.items_of(statement);
    const auto name = program.text_of(items[0].span);
    const auto test = std::string(program.text_of(statement_at(found.notes[0].span.begin).span));
    const auto tokens = repair::tokens_of(test, repair::Language::Structured);
    for (const auto& token : tokens)
      if (token.is_word() && equal_words(token.text, name))
        told.help = robot_texts::WriteInLoop(fmt::format("{}{}{}", test.substr(0, token.at),
                                                         program.text_of(items[1].span),
                                                         test.substr(token.at + name.size())));
  }

  /// The `delay` between a roll and the last statement, if no block is on the way and no other one
  /// is there; else that statement.
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

  /// A line that stops the ball in the direction in which it rolls.
  void tell_of_stop(const Diagnostic& found, const Statement& statement, Diagnostic& told) const {
    const auto& program = compiled_.program;
    std::string_view heading = "0";
    const auto* place = &statement;
    for (const auto& note : found.notes)
      if (const auto& roll = statement_at(note.span.begin);
          roll.kind == Kind::Robot && roll.robot == spec::Statement::Goroll) {
        const auto first = program.text_of(program.items_of(roll)[0].span);
        heading = is_digit(first[0]) ? first : heading;
        place = only_wait_below(roll, statement);
      }
    auto line = fmt::format("goroll {}, 0, 0", heading);
    const std::string end(line_end_of(program.text));
    const bool waits = // somewhere; else the linter adds a wait, too
        std::any_of(plain_.statements.begin(), plain_.statements.end(), [](const auto& plain) {
          return spec::info(plain.kind).after == spec::After::Waits;
        });
    const auto& last = *place;
    const bool ends = last.kind == Kind::Robot && last.robot == spec::Statement::End;
    if (!waits) {
      told.help = texts::AddTwo("delay 1s", line);
      line = "delay 1s" + end + line;
    } else if (&last != &statement) {
      told.help = texts::AddBelowOther(line, program.text_of(last.span));
    } else {
      told.help = (ends ? texts::AddAbove : texts::AddBelow)(line);
    }
    if (last.depth > 0 || last.one_line)
      return;
    const auto begin = last.span.begin;
    const auto rest = program.text.find_first_of("\r\n", last.span.end);
    const auto at = static_cast<std::uint32_t>(std::min(rest, program.text.size()));
    told.fix = Fix{told.help,
                   {ends ? Edit{{begin, begin}, line + end} : Edit{{at, at}, end + line}},
                   Safety::Unsafe};
  }

  /// The line to write is the source's own, with the one value replaced.
  void put_fix_into_source(const Fix& fix, const Statement& statement, Diagnostic& told) const {
    const auto& program = compiled_.program;
    const auto& edit = fix.edits.front();
    const auto* argument = argument_of(edit.span, statement);
    const auto there = argument != nullptr ? std::optional(argument->span)
                                           : same_number(plain_.text_of(edit.span), statement);
    if (!there)
      return;
    auto text = edit.text;
    for (auto comma = text.find(','); comma != std::string::npos; comma = text.find(',', comma + 1))
      text.insert(comma + 1, text.compare(comma + 1, 1, " ") == 0 ? "" : " ");
    told.help =
        texts::Write(fmt::format("{}{}{}", program.text_of({statement.span.begin, there->begin}),
                                 text, program.text_of({there->end, statement.span.end})));
    told.fix = Fix{told.help, {{*there, std::move(text)}}, Safety::Unsafe};
  }

  /// The only number of a statement that is written like one of its line.
  std::optional<Span> same_number(std::string_view number, const Statement& statement) const {
    std::optional<Span> found;
    for (const auto& item : compiled_.program.items_of(statement)) {
      if (item.kind != ItemKind::Expression)
        continue;
      for (auto n = compiled_.program.nodes[item.value].first; n <= item.value; ++n) {
        const auto& node = compiled_.program.nodes[n];
        if (node.kind != NodeKind::Number || compiled_.program.text_of(node.span) != number)
          continue;
        if (found)
          return std::nullopt;
        found = node.span;
      }
    }
    return found;
  }

  /// What the robot's line takes away where it sets a letter to the sum at `span`; 0 where it adds.
  std::int32_t taken_away(Span span) const {
    const auto sum = std::find_if(plain_.items.begin(), plain_.items.end(),
                                  [&](const compiler::Item& one) { return one.span == span; });
    if (sum == plain_.items.end() || sum->kind != compiler::ItemKind::Expression)
      return 0;
    const auto& root = plain_.nodes[sum->value];
    const bool subtracts = root.kind == compiler::NodeKind::Binary &&
                           static_cast<spec::Operator>(root.what) == spec::Operator::Subtract;
    return subtracts ? plain_.nodes[sum->value - 1].value : 0;
  }

  void tell_of_heading(const Diagnostic& found, const Statement& statement,
                       Diagnostic& told) const {
    const auto& program = compiled_.program;
    const auto items = program.items_of(statement);
    const auto name = program.text_of(items[0].span);
    auto sum = std::string(program.text_of(items[1].span));
    if (statement.operation != Statement::none_operation)
      sum = fmt::format("{} {} {}", name,
                        spec::info(static_cast<spec::Operator>(statement.operation)).symbol, sum);
    // The remainder of a value below 0 is below 0, too.
    const auto turn = spec::info(spec::Statement::Goroll).parameters()[0].greatest + 1;
    if (const auto step = taken_away(found.span); step > 0)
      sum = fmt::format("{} + {}", name, turn - step % turn);
    told.message.refill(0, Message::as_is(std::string(name)));
    told.help = texts::Write(fmt::format("{} = ({}) % {}", name, sum, turn));
  }

  void check_size(const compiler::Image& image) {
    const auto size = static_cast<std::int32_t>(image.bytes.size());
    const auto room = compiler::area_bytes(target_);
    const bool in_ram = target_.area == compiler::Area::Ram;
    const auto oldest = spec::value_of(spec::Limit::RamBytesUntil146);
    if (size <= room && (!in_ram || target_.ram_bytes || size <= oldest))
      return;
    const auto limit = static_cast<std::uint32_t>(size > room ? room : oldest);
    std::size_t first = 0;
    while (first + 1 < image.lines.size() &&
           image.lines[first].offset + image.lines[first].size < limit)
      ++first;
    auto& program = compiled_.program;
    const auto span = program.statements[compiled_.robot.lines[first].statement].span;
    if (size > room)
      program.diagnostics.push_back(
          finding(robot::ProgramTooLarge, span,
                  robot_texts::MoreThanAreaHolds(size, size - room, room, in_ram ? "RAM" : "flash"),
                  parts(image)));
    else
      program.diagnostics.push_back(
          finding(robot::LargerThanOldRam, span, robot_texts::MoreThanOldRobotsHold(size, oldest),
                  robot_texts::GiveRam(spec::value_of(spec::Limit::RamBytes))));
  }

  /// The largest parts of the program, in bytes.
  Message parts(const compiler::Image& image) const {
    std::map<std::uint32_t, std::uint32_t> bytes;
    for (std::size_t i = 0; i < image.lines.size(); ++i)
      bytes[compiled_.names.routine_of[compiled_.robot.lines[i].statement]] += image.lines[i].size;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted;
    for (const auto& [routine, size] : bytes)
      sorted.push_back({size, routine});
    std::sort(sorted.rbegin(), sorted.rend());
    constexpr std::size_t most = 3;
    Message largest;
    for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) {
      const auto [size, routine] = sorted[i];
      const auto symbol = compiled_.names.routines[routine].symbol;
      auto name = symbol == none
                      ? texts::TheMainProgram()
                      : texts::Quoted(compiled_.program.name(compiled_.names.symbols[symbol].name));
      largest = i == 0 ? texts::PartTakes(std::move(name), size)
                       : texts::PartsTake(std::move(largest), std::move(name), size);
    }
    return texts::LargestParts(std::move(largest));
  }

  Compiled& compiled_;
  const compiler::Target& target_;
  compiler::Program plain_;
};

} // namespace

void relay_findings(Compiled& compiled, const compiler::Target& target) {
  Relay(compiled, target).run();
}

void report_too_large(Compiled& compiled, const compiler::Target& target) {
  const auto room = compiler::area_bytes(target);
  compiled.program.diagnostics.push_back(finding(
      robot::ProgramTooLarge, compiled.program.statements.front().span, texts::FarLarger(room)));
}

} // namespace orb::structured
