#include "compiler/lint/line_pass.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/text/rules.h"
#include "spec/ball.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Statement;

/// The ball does not move visibly in a shorter roll.
constexpr std::int32_t unseen_roll_ms = 31;
constexpr std::int32_t unseen_colour_ms = 10;
/// Colours drawn anew each time are party lights, which may be fast.
constexpr std::int32_t unseen_party_ms = 6;

/// Finds numbers in range that cannot be intended: seconds for milliseconds, a brightness of 1.
class UnitsPass : private LinePass {
public:
  using LinePass::LinePass;

  void run() {
    each(Statement::Let, &UnitsPass::check_timer);
    each(Statement::If, &UnitsPass::check_comparisons);
    each(Statement::Delay, &UnitsPass::check_delay);
    each(Statement::Rgb, &UnitsPass::check_colour);
    each(Statement::Goroll, &UnitsPass::check_speed);
    each(Statement::BackLed, &UnitsPass::check_back_led);
    each(Statement::Input, &UnitsPass::check_input);
    each(Statement::Sleep, &UnitsPass::check_sleep);
    check_exchanged();
  }

private:
  std::optional<std::int32_t> number(const Item& item) const { return number_in(program_, item); }

  using Check = void (UnitsPass::*)(const StatementNode& statement, std::uint32_t code);
  void each(Statement kind, Check check) {
    for (const auto& place : flow_.all(kind))
      (this->*check)(program_.statements[place.statement], place.code);
  }

  /// If the only roll has speed 0 and the ball is then stopped, heading and speed are swapped.
  void check_exchanged() {
    const StatementNode* roll = nullptr;
    bool stops = false;
    const bool all_known = flow_.places.size() == program_.statements.size();
    if (!all_known || !flow_.all(Statement::Raw).empty() || !flow_.all(Statement::Macrun).empty())
      return;
    for (const auto& place : flow_.all(Statement::Goroll)) {
      const auto& statement = program_.statements[place.statement];
      const auto items = program_.items_of(statement);
      const auto go = items.size() == 3 ? number(items[2]) : std::nullopt;
      if (number(items[1]) != 0 || (go != 0 && (roll != nullptr || go != 1)))
        return;
      stops = stops || (roll != nullptr && go == 0);
      roll = go == 1 ? &statement : roll;
    }
    if (roll == nullptr || !stops)
      return;
    const auto items = program_.items_of(*roll);
    const auto speed = number(items[0]).value_or(0);
    if (speed <= 0 || speed > spec::info(Statement::Goroll).parameters()[1].greatest)
      return;
    auto& d = findings_.add(
        rules::NeverRolls, items[1].span, texts::BallNeverRolls(),
        texts::WriteBecause(fmt::format("goroll 0,{},1", speed), texts::HeadingComesFirst()));
    d.fix = Fix{texts::SwapHeadingAndSpeed(),
                {{items[0].span, "0"}, {items[1].span, std::to_string(speed)}},
                Safety::Unsafe};
  }

  // ---- time

  /// The statement of the line above, if nothing else leads here.
  const StatementNode* above(std::uint32_t code) const {
    if (code == 0 || flow_.code[code].target || !flow_.code[code - 1].falls)
      return nullptr;
    const auto& statement = statement_of(code - 1);
    return statement.error || statement.then_branch != none ? nullptr : &statement;
  }
  const StatementNode* below(std::uint32_t code) const {
    if (code + 1 == flow_.code.size() || flow_.code[code + 1].target)
      return nullptr;
    const auto& statement = statement_of(code + 1);
    return statement.error || statement.then_branch != none ? nullptr : &statement;
  }

  template <NodeKind kind>
  bool uses(const StatementNode& statement) const {
    return std::any_of(program_.items_of(statement).begin(), program_.items_of(statement).end(),
                       [&](const Item& item) {
                         const auto nodes = nodes_of(program_, item);
                         return std::any_of(nodes.begin(), nodes.end(),
                                            [](const Node& node) { return node.kind == kind; });
                       });
  }
  bool is_fixed(const StatementNode& statement) const {
    return !uses<NodeKind::Letter>(statement) && !uses<NodeKind::Indexed>(statement) &&
           !uses<NodeKind::System>(statement);
  }

  void check_delay(const StatementNode& statement, std::uint32_t code) {
    const auto& time = program_.items_of(statement)[0];
    const auto ms = number(time);
    const auto* shown = above(code);
    if (!ms || *ms < 1 || *ms >= unseen_roll_ms || shown == nullptr || !is_fixed(*shown))
      return;
    const bool colour = shown->kind == Statement::Rgb || shown->kind == Statement::Ledc ||
                        shown->kind == Statement::BackLed;
    const auto limit = uses<NodeKind::Call>(*shown) ? unseen_party_ms : unseen_colour_ms;
    if ((colour && *ms < limit) || (shown->kind == Statement::Goroll && ends_roll(code)))
      add_time(time, *ms, waits(fmt::format("delay {}", *ms), *ms),
               fmt::format("delay {}", *ms * in_second));
  }

  /// True if another roll or the end of the program directly follows a delay.
  bool ends_roll(std::uint32_t code) const {
    const auto* next = below(code);
    return next != nullptr && (next->kind == Statement::Goroll || next->kind == Statement::End);
  }

  /// A number that is asked for once, or after a print, comes from a person; a client can be
  /// faster.
  void check_input(const StatementNode& statement, std::uint32_t code) {
    const auto input = program_.as<InputView>(statement);
    const auto* asked = above(code);
    const bool polls = (asked == nullptr || asked->kind != Statement::Print) && in_loop(code);
    if (input.milliseconds == nullptr || polls)
      return;
    const auto ms = number(*input.milliseconds);
    if (ms && *ms > 0 && *ms < least_meant)
      add_time(*input.milliseconds, *ms, waits("input", *ms),
               with_value(statement, *input.milliseconds, *ms * in_second));
  }

  void check_timer(const StatementNode& statement, std::uint32_t code) {
    const auto let = program_.as<LetView>(statement);
    if (let.variable.kind != ItemKind::System)
      return;
    const auto timer = static_cast<spec::Variable>(let.variable.value);
    const auto ms = number(let.expression);
    if (ms != 0)
      timers_.set_above_0(timer);
    if (!is_timer(timer) || !ms || *ms < 2 || *ms >= least_meant || in_loop(code))
      return; // 1 is practically over
    const auto& row = spec::variables[let.variable.value];
    add_time(let.expression, *ms, texts::TimerReachesZero(row.word, *ms),
             fmt::format("{} = {}", row.word, *ms * in_second));
  }

  /// True if a line is inside a jump back.
  bool in_loop(std::uint32_t code) const {
    for (auto i = code; i < flow_.code.size() && i - code < longest_loop; ++i) {
      if (program_.statements[flow_.code[i].statement].kind == Statement::Next)
        return true;
      for (const auto& jump : flow_.jumps_of(flow_.code[i]))
        if (!jump.call && jump.to <= code)
          return true;
    }
    return false;
  }

  void add_time(const Item& time, std::int32_t ms, Message message, const std::string& line) {
    auto& d = findings_.add(rules::WrongUnit, time.span, std::move(message), for_seconds(ms, line));
    d.fix = single_fix(d.help, time.span, std::to_string(ms * in_second), Safety::Unsafe);
  }

  static Message for_seconds(std::int32_t seconds, const std::string& line) {
    return seconds == 1 ? texts::ForOneSecond(line) : texts::ForSeconds(seconds, line);
  }
  static Message waits(std::string_view line, std::int32_t ms) {
    return ms == 1 ? texts::WaitsOne(line) : texts::Waits(line, ms);
  }

  void check_sleep(const StatementNode& statement, std::uint32_t /*code*/) {
    const auto& time = program_.as<SleepView>(statement).seconds;
    const auto seconds = number(time);
    if (!seconds || *seconds == 0 || *seconds % in_second != 0)
      return;
    const auto meant = *seconds / in_second;
    auto& d = findings_.add(rules::WrongUnit, time.span,
                            texts::SleepCountsInSeconds(*seconds, *seconds / 60),
                            for_seconds(meant, with_value(statement, time, meant)));
    d.fix = single_fix(d.help, time.span, std::to_string(meant), Safety::Unsafe);
  }

  // ---- speeds and lights

  void check_speed(const StatementNode& statement, std::uint32_t /*code*/) {
    const auto items = program_.items_of(statement);
    const auto& speed = items[1];
    const auto value = number(speed);
    constexpr std::int32_t crawls = 5; // 4 cm/s and less: nothing starts to roll
    if (!value || *value < 1 || *value >= crawls || (items.size() > 2 && number(items[2]) == 0))
      return;
    constexpr std::int32_t brisk = 100; // fast enough for a first try
    add_tiny(statement, speed, texts::BarelyMoves(*value, spec::ball::greatest), brisk);
  }

  void check_back_led(const StatementNode& statement, std::uint32_t /*code*/) {
    const auto& value = program_.items_of(statement)[0];
    if (number(value) == 1)
      add_tiny(statement, value, texts::BrightnessInvisible(spec::ball::greatest),
               spec::ball::greatest);
  }

  void add_tiny(const StatementNode& statement, const Item& value, Message message,
                std::int32_t meant) {
    auto& d = findings_.add(rules::TinyValue, value.span, std::move(message),
                            texts::Write(with_value(statement, value, meant)));
    d.fix = single_fix(d.help, value.span, std::to_string(meant), Safety::Unsafe);
  }

  void check_colour(const StatementNode& statement, std::uint32_t /*code*/) {
    std::string line;
    std::int32_t sum = 0;
    for (const auto& item : program_.items_of(statement)) {
      const auto value = number(item);
      if (!value || *value < 0 || *value > 1)
        return;
      sum += *value;
      line += fmt::format("{}{}", line.empty() ? "RGB " : ",", *value * spec::ball::greatest);
    }
    if (sum == 0)
      return;
    auto& d = findings_.add(rules::TinyValue, statement.span,
                            texts::BrightnessInvisible(spec::ball::greatest), texts::Write(line));
    d.fix = single_fix(d.help, statement.span, line, Safety::Unsafe);
  }

  // ---- comparisons

  void check_comparisons(const StatementNode& statement, std::uint32_t /*code*/) {
    const auto condition = program_.as<IfView>(statement);
    check_comparison(condition.first);
    if (condition.second)
      check_comparison(*condition.second);
  }

  void check_comparison(const Comparison& comparison) {
    const auto test = sensor_test(program_, comparison);
    if (!test)
      return;
    const Span all{comparison.left.span.begin, comparison.right.span.end};
    const SensorQuestion question{test->sensor, test->orders, test->number, false, "!"};
    const auto answer = judge(question, program_.text_of(all), timers_);
    if (!answer)
      return;
    auto& d = findings_.add(*answer->rule, all, answer->message, answer->help);
    if (!answer->line.empty())
      d.fix = single_fix(d.help, all, answer->line, Safety::Unsafe);
  }

  // ---- words

  /// The statement with one of its values replaced.
  std::string with_value(const StatementNode& statement, const Item& item,
                         std::int32_t value) const {
    return fmt::format("{}{}{}", program_.text_of({statement.span.begin, item.span.begin}), value,
                       program_.text_of({item.span.end, statement.span.end}));
  }

  static constexpr const spec::SmallUnit& milliseconds = *spec::find_small_unit("ms");
  static constexpr std::int32_t in_second = milliseconds.in_whole;
  static constexpr std::int32_t least_meant = milliseconds.least_meant;

  Timers timers_;
};

} // namespace

void lint_units(const Program& program, const Flow& flow, Findings& findings) {
  UnitsPass(program, flow, findings).run();
}

} // namespace orb::compiler
