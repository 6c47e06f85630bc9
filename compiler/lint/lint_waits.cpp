#include "compiler/lint/line_pass.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Statement;

/// Finds loops that wait for an impossible event, and loops used as a delay.
class WaitsPass : private LinePass {
public:
  WaitsPass(const Program& program, const Flow& flow, const Settings& settings, Findings& findings)
      : LinePass(program, flow, findings), settings_(settings) {}

  void run() {
    for (const auto& place : flow_.all(Statement::For))
      if (flow_.is_line(place))
        check_loop(program_.statements[place.statement], place.code);
    for (const auto& jump : flow_.jumps)
      // `on` may have thousands of targets, and has no condition.
      if (!jump.call && jump.to <= jump.from && jump.from - jump.to < longest_loop &&
          statement_of(jump.from).kind != Statement::On)
        check_back(statement_of(jump.from), jump, jump.from);
  }

private:
  std::optional<std::int32_t> number(const Item& item) const { return number_in(program_, item); }

  // ---- loops that count

  void check_loop(const StatementNode& statement, std::uint32_t begin) {
    const auto loop = program_.as<ForView>(statement);
    const auto first = number(loop.start);
    const auto last = number(loop.end);
    const auto step = loop.step == nullptr ? std::optional(1) : step_of(*loop.step);
    if (loop.variable.kind != ItemKind::Letter || !first || !last || !step || *step == 0)
      return;
    const auto rounds = (std::int64_t{*last} - *first) / *step + 1;
    std::int64_t reads = 0;
    const StatementNode* let = nullptr; // the last that assigns the variable
    for (auto i = begin + 1; i < size_ && i - begin < longest_loop; ++i) {
      if (!is_single(i) || flow_.code[i].target)
        return;
      const auto& inside = statement_of(i);
      if (inside.kind == Statement::Next) {
        if (i == begin + 1)
          check_empty(statement, loop, rounds);
        if (reads > 0 && rounds > 0)
          check_data(begin, i, read_above(begin) + rounds * reads);
        if (let != nullptr)
          check_reset(*let, statement, *last, *step);
        return;
      }
      if (inside.kind == Statement::Read)
        reads += static_cast<std::int64_t>(program_.items_of(inside).size());
      for (const auto& item : program_.items_of(inside))
        if (item.kind == ItemKind::Letter && item.value == loop.variable.value)
          let = inside.kind == Statement::Let ? &inside : nullptr;
      if (spec::info(inside.kind).after != spec::After::Falls &&
          spec::info(inside.kind).after != spec::After::Waits)
        return;
    }
  }

  std::optional<std::int32_t> step_of(const Item& step) const {
    const auto& node = bare(program_, step);
    if (node.kind == NodeKind::Negate)
      if (const auto& operand = (&node)[-1]; operand.kind == NodeKind::Number)
        return -operand.value;
    return number(step);
  }

  void check_empty(const StatementNode& statement, const ForView& loop, std::int64_t rounds) {
    constexpr std::int64_t least_rounds = 100;    // fewer take no noticeable time
    constexpr std::int64_t ms_of_a_second = 1000; // not a fact about the robot
    const auto ms = rounds * ms_of_a_second / spec::value_of(spec::Limit::LinesPerSecond);
    const auto most = spec::info(Statement::Delay).parameters()[0].greatest;
    if (rounds < least_rounds || ms > most)
      return;
    findings_.add(rules::EmptyLoop, Span{statement.span.begin, loop.last().span.end},
                  texts::BusyWaitOf(ms), texts::WriteInsteadOfLoop(fmt::format("delay {}", ms)));
  }

  // ---- values read in loops

  /// The only `data` of the program, if no `rstr` restarts it; null otherwise.
  const StatementNode* only_data() const {
    const StatementNode* found = nullptr;
    for (const auto& statement : program_.statements) {
      if (statement.error || statement.kind == Statement::Rstr)
        return nullptr;
      if (statement.kind != Statement::Data)
        continue;
      if (found != nullptr)
        return nullptr;
      found = &statement;
    }
    return found;
  }

  /// The number of values that the lines above certainly read before the loop that begins here.
  std::int64_t read_above(std::uint32_t begin) const {
    std::int64_t reads = 0;
    for (auto i = begin; i > 0 && begin - i < longest_loop; --i) {
      if (flow_.code[i].target || !is_single(i - 1) || !flow_.code[i - 1].falls)
        return reads;
      if (statement_of(i - 1).kind == Statement::Data)
        return reads;
      if (statement_of(i - 1).kind == Statement::Read)
        reads += static_cast<std::int64_t>(program_.items_of(statement_of(i - 1)).size());
    }
    return reads;
  }

  /// A loop whose rounds read more values than there are; no `reads` means endless.
  void check_data(std::uint32_t first, std::uint32_t last, std::optional<std::int64_t> reads) {
    const auto* data = only_data();
    if (data == nullptr || (&statement_of(first) <= data && data <= &statement_of(last)))
      return;
    const auto values = static_cast<std::int64_t>(program_.items_of(*data).size());
    if (reads.value_or(values + 1) <= values)
      return;
    const StatementNode* read = nullptr;
    for (auto i = first; i <= last && read == nullptr; ++i)
      read = statement_of(i).kind == Statement::Read ? &statement_of(i) : nullptr;
    auto& d = reads ? findings_.add(rules::ReadPastData, read->span,
                                    texts::LoopReads(*reads, "data", values),
                                    add_values(*reads - values, program_.text_of(data->span)))
                    : findings_.add(rules::ReadPastData, read->span,
                                    counted(static_cast<std::size_t>(values),
                                            texts::LoopReadsForeverOne, texts::LoopReadsForever),
                                    texts::WriteRstr());
    d.severity = Severity::Warning;
    add_note(d, data->span, texts::TheValues());
  }

  static Message add_values(std::int64_t n, std::string_view line) {
    return n == 1 ? texts::AddOneValue(line) : texts::AddValues(n, line);
  }

  /// An endless loop without a condition, which reads in each round.
  void check_endless_read(std::uint32_t first, std::uint32_t last) {
    bool reads = false;
    for (auto i = first; i <= last; ++i) {
      if (!is_single(i) || flow_.code[i].ends || flow_.code[i].loops)
        return;
      for (const auto& jump : flow_.jumps_of(flow_.code[i]))
        if (i != last || jump.call)
          return;
      reads = reads || statement_of(i).kind == Statement::Read;
    }
    if (reads)
      check_data(first, last, std::nullopt);
  }

  void check_reset(const StatementNode& inside, const StatementNode& statement, std::int32_t last,
                   std::int32_t step) {
    const auto value = number(program_.as<LetView>(inside).expression);
    if (!value)
      return;
    const auto next = std::int64_t{*value} + step;
    if (step > 0 ? next > last : next < last)
      return; // the loop ends after this round
    auto& d = findings_.add(rules::LoopVariableSet, inside.span,
                            texts::EachIterationSetsBack(*value), texts::UseAnotherVariable());
    add_note(d, statement.span, texts::TheLoop());
  }

  // ---- loops that wait

  void check_back(const StatementNode& statement, const Flow::Jump& jump, std::uint32_t code) {
    if (jump.to == code && statement.kind == Statement::If && statement.else_branch == none)
      check_inverted(statement, code);
    if (statement.kind == Statement::Goto)
      check_endless_read(jump.to, code);
    if (statement.kind == Statement::If)
      check_restart(statement, jump, code);
    check_stale(jump.to, code);
  }

  /// `if A < 5 then goto 10` where line 10 is `A = 0`: each round resets the counter.
  void check_restart(const StatementNode& statement, const Flow::Jump& jump, std::uint32_t code) {
    const auto& begin = statement_of(jump.to);
    const auto condition = program_.as<IfView>(statement);
    const auto letter = letter_in(program_, condition.first.left);
    const auto limit = number(condition.first.right);
    if (begin.error || begin.kind != Statement::Let || statement.else_branch != none ||
        condition.second || !letter || !limit || settings_[*letter].size() != 2)
      return;
    const auto let = program_.as<LetView>(begin);
    const auto first = number(let.expression);
    const auto set = std::max(settings_[*letter][0].code, settings_[*letter][1].code); // the one
                                                                                       // below
    if (let.variable.kind != ItemKind::Letter || let.variable.value != *letter || !first ||
        set <= jump.to || set >= code || !is_single(set))
      return;
    const auto step = step_in(statement_of(set));
    const Bound test{orders_of(condition.first), *limit};
    if (step.letter != *letter || !test.holds(*first) || !test.holds(*first + step.by))
      return;
    const auto number_of = [&](std::uint32_t line) {
      return program_.lines[flow_.code[line].line].number;
    };
    const auto& target = program_.items[jump.item].span;
    const Span line{statement.span.begin, target.begin};
    auto& d = findings_.add(
        rules::LoopVariableSet, target,
        texts::LineSetsBack(number_of(jump.to), spec::letter_name(*letter), *first),
        texts::Write(fmt::format("{}{}", program_.text_of(line), number_of(jump.to + 1))));
    d.fix = single_fix(d.help, target, std::to_string(number_of(jump.to + 1)), Safety::Unsafe);
    add_note(d, begin.span, texts::SetHere());
  }

  /// A line that jumps to itself while a condition holds that ends at once.
  void check_inverted(const StatementNode& statement, std::uint32_t code) {
    const auto condition = program_.as<IfView>(statement);
    const auto test = sensor_test(program_, condition.first);
    if (!test || condition.second)
      return;
    const auto& row = spec::info(test->sensor);
    if (row.access == spec::Access::ReadClears && test->holds(row.greatest) &&
        !test->holds(row.least))
      return add_inverted(statement, condition.first, row,
                          texts::ForOneReadingOnly(row.word, row.greatest),
                          fmt::format("{} = {}", row.word, row.least));
    const auto set =
        is_timer(test->sensor) ? set_above(test->sensor, code, Waits::None) : std::nullopt;
    if (!set || test->holds(*set))
      return;
    const bool down = *set > 0;
    add_inverted(statement, condition.first, row, texts::TimerStartsAt(row.word, *set),
                 fmt::format("{} {} {}", row.word, down ? ">" : "<",
                             down ? test->number : std::max(test->number, 0)));
  }

  void add_inverted(const StatementNode& statement, const Comparison& comparison,
                    const spec::VariableInfo& row, Message message, const std::string& until) {
    const Span test{comparison.left.span.begin, comparison.right.span.end};
    const auto rest =
        program_.text_of({test.end, program_.statements[statement.then_branch].span.end});
    auto& d = findings_.add(rules::InvertedWait, test, std::move(message),
                            texts::ToWaitForWrite(row.word, fmt::format("if {}{}", until, rest)));
    d.fix = single_fix(d.help, test, until, Safety::Unsafe);
  }

  /// A loop whose only exit tests a letter that no line in it assigns.
  void check_stale(std::uint32_t first, std::uint32_t last) {
    const StatementNode* test = nullptr;
    std::uint32_t test_code = none;
    for (auto i = first; i <= last; ++i) {
      const auto& statement = statement_of(i);
      const auto& code = flow_.code[i];
      if (statement.error || statement.kind == Statement::On ||
          (code.ends && statement.kind != Statement::If))
        return;
      for (const auto& jump : flow_.jumps_of(code))
        if (jump.call || (statement.kind != Statement::If && (jump.to < first || jump.to > last)))
          return;
      if (statement.kind != Statement::If)
        continue;
      if (test != nullptr)
        return;
      test = &statement;
      test_code = i;
    }
    if (test == nullptr || test->else_branch != none)
      return;
    const auto condition = program_.as<IfView>(*test);
    const auto letter = letter_in(program_, condition.first.left);
    if (condition.second || !letter || !number(condition.first.right))
      return;
    if (settings_[*letter].size() != 1)
      return;
    const auto set = settings_[*letter].front().code;
    if (first <= set && set <= last)
      return;
    const auto& copy = original_of(statement_of(set));
    const auto jumps = flow_.jumps_of(flow_.code[test_code]);
    if (copy.kind != Statement::Let || jumps.empty())
      return;
    const auto to = jumps.front().to;
    const auto& value = program_.as<LetView>(copy).expression;
    const auto sensor = sensor_in(program_, value);
    if (!sensor)
      return check_unchanged(*test, first <= to && to <= last, number(value));
    auto& d = findings_.add(
        rules::StaleSensor, copy.span, texts::ReadOnceBeforeLoop(spec::info(*sensor).word),
        texts::WriteInLoop(
            fmt::format("if {}{}", program_.text_of(value.span),
                        program_.text_of({condition.first.left.span.end,
                                          program_.statements[test->then_branch].span.end}))));
    add_note(d, test->span, texts::LoopTestsCopyHere());
  }

  /// Follows copies of copies to the first one, if each is assigned once.
  const StatementNode& original_of(const StatementNode& copy) const {
    constexpr int most = 4; // a cycle of copies has no first one
    const auto* at = &copy;
    for (int i = 0; i < most && !at->error && at->kind == Statement::Let; ++i) {
      const auto letter = letter_in(program_, program_.as<LetView>(*at).expression);
      if (!letter || settings_[*letter].size() != 1)
        break;
      at = &statement_of(settings_[*letter].front().code);
    }
    return *at;
  }

  /// A loop that tests a letter with a constant value from above the loop.
  void check_unchanged(const StatementNode& test, bool back, std::optional<std::int32_t> value) {
    const auto condition = program_.as<IfView>(test).first;
    const Bound asked{orders_of(condition), number(condition.right).value_or(0)};
    if (!value || asked.holds(*value) != back)
      return;
    const auto name = program_.text_of(condition.left.span);
    const bool down = back == (asked.orders == Orders::Greater);
    findings_.add(rules::EndlessLoop, Span{condition.left.span.begin, condition.right.span.end},
                  texts::NothingChanges(name),
                  texts::AddToLoop(stepped(program_, name, down ? '-' : '+', 1)));
  }

  const Settings& settings_;
};

} // namespace

void lint_waits(const Program& program, const Flow& flow, const Settings& settings,
                Findings& findings) {
  WaitsPass(program, flow, settings, findings).run();
}

} // namespace orb::compiler
