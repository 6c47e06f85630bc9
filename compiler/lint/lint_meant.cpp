#include "compiler/analyse/letter_flow.h"
#include "compiler/lint/line_pass.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/lint/sums.h"
#include "compiler/text/rules.h"
#include "spec/api.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace orb::compiler {
namespace {

using spec::Statement;
using spec::Variable;

constexpr std::int32_t quarter = full_turn / 4;

/// Finds programs that run without an error but cannot be intended: loops that end at once or
/// never, tests that the ball's own path decides. Large because each rule recognises its own
/// pattern of lines.
class MeantPass : private LinePass {
public:
  MeantPass(const Program& program, const Flow& flow, const Settings& settings, Findings& findings)
      : LinePass(program, flow, findings), settings_(settings) {}

  void run() {
    for (const auto& place : flow_.all(Statement::Goroll))
      if (flow_.is_line(place))
        check_early_test(place.code);
    for (const auto& place : flow_.all(Statement::Let))
      if (flow_.is_line(place))
        check_copy(place.code);
    for (const auto& place : flow_.all(Statement::Raw))
      if (flow_.is_line(place))
        check_roll_below(place.code);
    for (const auto& place : flow_.all(Statement::For))
      if (flow_.is_line(place)) {
        check_turns(place.code);
        if (const auto next = next_below(place.code); next > place.code + 1)
          check_data(place.code + 1, next - 1);
      }
    for (const auto& jump : flow_.jumps)
      if (!jump.call && jump.to <= jump.from && jump.from - jump.to < longest_loop)
        check_back(jump);
    check_extremes();
  }

private:
  std::optional<std::int32_t> number(const Item& item) const { return constant_in(program_, item); }

  // ---- sensors that cannot have changed yet

  /// Follows a roll along the only path to a test that is reached in no time. The ball must be at
  /// rest: no roll comes before.
  void check_early_test(std::uint32_t roll) {
    const auto items = program_.items_of(statement_of(roll));
    for (std::uint32_t i = 0; i < roll; ++i)
      if (!is_plain(i) || flow_.code[i].target || statement_of(i).kind == Statement::Goroll)
        return;
    if (number(items[1]).value_or(1) <= 0 || flow_.code[roll].target)
      return;
    constexpr int most_steps = 8;
    auto at = roll + 1;
    for (int step = 0; step < most_steps && at < size_; ++step) {
      const auto& statement = statement_of(at);
      if (statement.error || flow_.code[at].waits || flow_.code[at].loops)
        return;
      if (statement.kind == Statement::If)
        return judge_early(at);
      if (statement.kind == Statement::Goto)
        at = flow_.jumps_of(flow_.code[at]).front().to;
      else if (is_plain(at))
        ++at;
      else
        return;
    }
  }

  void judge_early(std::uint32_t at) {
    const auto condition = program_.as<IfView>(statement_of(at));
    const auto test = sensor_test(program_, condition.first);
    const auto jumps = flow_.jumps_of(flow_.code[at]);
    if (!test || test->sensor != Variable::Speed || condition.second || jumps.size() != 1)
      return;
    // A loop that is left at once, at its end or from within; where the test continues it, it does
    // wait.
    const bool back = jumps.front().to <= at;
    if (test->holds(0) == back || (!back && jumps.front().to <= end_of_loop(at)))
      return;
    findings_.add(rules::EarlySensor, span_of(condition.first), texts::TestedAtRest(),
                  texts::WaitBeforeIt("delay 500"));
  }

  /// The last line that jumps back to a line or above it; 0 if there is none.
  std::uint32_t end_of_loop(std::uint32_t at) const {
    std::uint32_t end = 0;
    for (const auto& jump : flow_.jumps)
      if (!jump.call && jump.to <= at && at <= jump.from)
        end = std::max(end, jump.from);
    return end;
  }

  /// A copy of a place or the speed that the lines right below subtract from it.
  void check_copy(std::uint32_t code) {
    const auto let = program_.as<LetView>(statement_of(code));
    const auto sensor = sensor_in(program_, let.expression);
    if (let.variable.kind != ItemKind::Letter || !sensor ||
        (spec::info(*sensor).unit != "cm" && *sensor != Variable::Speed))
      return;
    const auto is_one = [&](const Node& node) {
      return (node.kind == NodeKind::System && static_cast<Variable>(node.what) == *sensor) ||
             (node.kind == NodeKind::Letter && node.what == let.variable.value);
    };
    constexpr std::uint32_t near = 4;
    for (auto i = code + 1; i < size_ && i - code <= near && !flow_.code[i].target; ++i) {
      const auto& statement = statement_of(i);
      for (auto n = statement.nodes_begin; !statement.error && n < statement.nodes_end; ++n) {
        const auto& node = program_.nodes[n];
        if (node.kind != NodeKind::Binary || node.first + 2 != n ||
            static_cast<spec::Operator>(node.what) != spec::Operator::Subtract)
          continue;
        const auto& left = program_.nodes[n - 2];
        const auto& right = program_.nodes[n - 1];
        if (left.kind != right.kind && is_one(left) && is_one(right)) {
          auto& d = findings_.add(rules::EarlySensor, node.span,
                                  texts::CopiedJustNow(program_.text_of(node.span)));
          add_note(d, statement_of(code).span, texts::SetHere());
        }
      }
      const bool sets = !statement.error && statement.kind == Statement::Let &&
                        program_.items_of(statement)[0].kind == ItemKind::Letter &&
                        program_.items_of(statement)[0].value == let.variable.value;
      if (!is_plain(i) || sets || statement.kind == Statement::Locate ||
          spec::info(statement.kind).after != spec::After::Falls)
        return;
    }
  }

  // ---- rolls while stabilization is off

  void check_roll_below(std::uint32_t raw) {
    const auto motors = program_.items_of(statement_of(raw));
    constexpr std::int32_t ignored = spec::motor_mode::ignore;
    if (!number(motors[0]) || !number(motors[2]) ||
        (number(motors[0]) == ignored && number(motors[2]) == ignored))
      return;
    for (auto at = raw + 1; at < size_ && at - raw < longest_loop && is_plain(at); ++at) {
      const auto& statement = statement_of(at);
      if (flow_.code[at].target || statement.kind == Statement::Raw ||
          statement.kind == Statement::Macrun || sets(statement, Variable::Ctrl))
        return;
      if (statement.kind != Statement::Goroll)
        continue;
      const auto items = program_.items_of(statement);
      if (items.size() < 3 || number(items[1]).value_or(0) <= 0 || number(items[2]) != 1)
        return;
      auto& d = findings_.add(rules::NeverRolls, statement.span, texts::NotStabilized(),
                              texts::AddAboveThisLine("ctrl = 1"));
      add_note(d, statement_of(raw).span, texts::TurnedOffHere());
      return;
    }
  }

  // ---- loops that count

  /// `for I = 0 to 4` around a turn by 90: four turns make a circle.
  void check_turns(std::uint32_t begin) {
    const auto loop = program_.as<ForView>(statement_of(begin));
    const auto last = number(loop.end);
    if (loop.variable.kind != ItemKind::Letter || number(loop.start) != 0 || !last || *last < 2 ||
        loop.step != nullptr)
      return;
    std::optional<std::int32_t> turn;
    bool rolls = false;
    for (auto i = begin + 1; i < size_ && i - begin < longest_loop; ++i) {
      const auto& statement = statement_of(i);
      if (statement.kind == Statement::Next && !statement.error)
        break;
      if (!is_plain(i) || flow_.code[i].loops)
        return;
      rolls = rolls || statement.kind == Statement::Goroll;
      const auto found = turn_in(statement, loop.variable.value);
      if (turn && found)
        return;
      turn = turn ? turn : found;
    }
    if (!turn || !rolls || std::int64_t{*turn} * *last != full_turn)
      return;
    const Span counted{loop.variable.span.begin, loop.end.span.end};
    const auto meant = fmt::format("{} = 1 to {}", program_.text_of(loop.variable.span), *last);
    auto& d =
        findings_.add(rules::ExtraTurn, counted, texts::TurnsOnceMore(*last + 1, *last, *turn),
                      texts::Write("for " + meant));
    d.fix = single_fix(d.help, counted, meant, Safety::Unsafe);
  }

  /// The first `next` below a line; 0 if there is none.
  std::uint32_t next_below(std::uint32_t line) const {
    for (auto i = line + 1; i < size_ && i - line < longest_loop; ++i)
      if (!statement_of(i).error && statement_of(i).kind == Statement::Next)
        return i;
    return 0;
  }

  /// The turn of a line per round: `H = (H + 90) % 360`, or `goroll I * 90 % 360,…`.
  std::optional<std::int32_t> turn_in(const StatementNode& statement, std::uint32_t counter) const {
    if (statement.kind != Statement::Let && statement.kind != Statement::Goroll)
      return std::nullopt;
    const auto items = program_.items_of(statement);
    const auto& sum = statement.kind == Statement::Let ? items[1] : items[0];
    const auto op =
        statement.kind == Statement::Let ? spec::Operator::Add : spec::Operator::Multiply;
    const auto letter = statement.kind == Statement::Let ? items[0].value : counter;
    if (items[0].kind != ItemKind::Letter && statement.kind == Statement::Let)
      return std::nullopt;
    const auto& root = program_.nodes[sum.value];
    const bool wraps = root.kind == NodeKind::Binary &&
                       static_cast<spec::Operator>(root.what) == spec::Operator::Remainder &&
                       program_.nodes[sum.value - 1].value == full_turn;
    if (!wraps)
      return std::nullopt; // it leaves the range, which another rule reports
    for (const auto& node : nodes_of(program_, sum)) {
      if (node.kind != NodeKind::Binary || static_cast<spec::Operator>(node.what) != op)
        continue;
      const auto& left = program_.nodes[node.first];
      const auto& right = *(&node - 1);
      if (left.kind == NodeKind::Letter && left.what == letter && right.kind == NodeKind::Number &&
          &left + 1 == &right)
        return right.value;
    }
    return std::nullopt;
  }

  // ---- loops that wait

  void check_back(const Flow::Jump& jump) {
    const auto& statement = statement_of(jump.from);
    if (jump.to < jump.from)
      check_data(jump.to, jump.from);
    if (statement.error || statement.kind != Statement::If || statement.else_branch != none)
      return;
    const auto condition = program_.as<IfView>(statement);
    if (condition.second)
      return;
    for (auto i = jump.to; i < jump.from; ++i)
      if (!is_plain(i))
        return;
    check_once(condition.first, jump);
    check_timer(condition.first, jump);
    check_place(condition.first, jump);
  }

  /// A loop that assigns the tested letter one value, at which it ends.
  void check_once(const Comparison& test, const Flow::Jump& jump) {
    const auto letter = letter_in(program_, test.left);
    const auto limit = number(test.right);
    if (!letter || !limit || jump.to == jump.from)
      return;
    const Setting* only = nullptr;
    for (const auto& setting : settings_[*letter])
      if (jump.to <= setting.code && setting.code < jump.from) {
        if (only != nullptr)
          return;
        only = &setting;
      }
    const auto value =
        only != nullptr && only->value != nullptr ? number(*only->value) : std::nullopt;
    if (!value || Bound{orders_of(test), *limit}.holds(*value))
      return;
    const auto name = program_.text_of(test.left.span);
    auto& d = findings_.add(rules::LoopRunsOnce, statement_of(only->code).span,
                            texts::EndsAfterOne(name, *value));
    if (*value >= 0)
      return;
    const auto step = stepped(program_, name, '-', -std::int64_t{*value});
    d.help = texts::Write(step);
    d.fix = single_fix(d.help, statement_of(only->code).span, step, Safety::Unsafe);
  }

  /// A timer that counts down past the value that a loop waits for, and stays at 0.
  void check_timer(const Comparison& comparison, const Flow::Jump& jump) {
    const auto test = sensor_test(program_, comparison);
    if (!test || !is_timer(test->sensor))
      return;
    for (auto i = jump.to; i < jump.from; ++i)
      if (sets(statement_of(i), test->sensor))
        return;
    const auto from = set_above(test->sensor, jump.to, Waits::Allowed);
    // A timer equals a number only for an instant.
    if (test->orders != Orders::Less || !from || *from <= 0 || !test->holds(0) ||
        !test->holds(*from - 1))
      return;
    findings_.add(rules::EndlessLoop, span_of(comparison),
                  texts::TimerCountsDown(spec::info(test->sensor).word, *from),
                  texts::WaitForZero());
  }

  /// Data that each round reads from its start again.
  void check_data(std::uint32_t first, std::uint32_t last) {
    const StatementNode* data = nullptr;
    std::size_t reads = 0;
    for (auto i = first; i <= last; ++i) {
      const auto& statement = statement_of(i);
      if (statement.error || flow_.code[i].loops || (flow_.code[i].target && i > first) ||
          (statement.then_branch != none && i < last) || has_call(i))
        return; // the order of these reads is not analysed
      if (statement.kind == Statement::Data && std::exchange(data, &statement) != nullptr)
        return;
      if (statement.kind == Statement::Read)
        reads += program_.items_of(statement).size();
    }
    judge_data(data, reads);
  }

  bool has_call(std::uint32_t code) const {
    const auto jumps = flow_.jumps_of(flow_.code[code]);
    return std::any_of(jumps.begin(), jumps.end(), [](const auto& jump) { return jump.call; });
  }

  void judge_data(const StatementNode* data, std::size_t reads) {
    if (data == nullptr || reads == 0 || reads >= program_.items_of(*data).size())
      return;
    findings_.add(rules::DataReplaced, data->span, texts::DataStartsAnew(),
                  texts::WriteAboveLoop(program_.text_of(data->span)));
  }

  // ---- places that no roll leads to

  /// The only heading of a program, a multiple of 90; nothing if there are others, or if something
  /// else moves the ball or sets its place. Between opposite headings it drives curves.
  std::optional<std::int32_t> only_heading() const {
    if (!flow_.all(Statement::Raw).empty() || !flow_.all(Statement::Macrun).empty() ||
        !flow_.all(Statement::Heading).empty() || flow_.places.size() != program_.statements.size())
      return std::nullopt;
    for (const auto& place : flow_.all(Statement::Locate))
      for (const auto& item : program_.items_of(program_.statements[place.statement]))
        if (number(item) != 0)
          return std::nullopt;
    std::optional<std::int32_t> only;
    for (const auto& place : flow_.all(Statement::Goroll)) {
      const auto items = program_.items_of(program_.statements[place.statement]);
      const auto heading = number(items[0]);
      if (number(items[1]) == 0)
        continue;
      if (!heading || *heading % quarter != 0 || (only && only != heading))
        return std::nullopt;
      only = heading;
    }
    return only;
  }

  /// A wait loop for a place that the only roll above it does not lead to.
  void check_place(const Comparison& comparison, const Flow::Jump& jump) {
    const auto test = sensor_test(program_, comparison);
    if (!test || (test->sensor != Variable::Xpos && test->sensor != Variable::Ypos))
      return;
    const auto rolls = flow_.all(Statement::Goroll);
    const auto heading = only_heading();
    if (!heading || rolls.empty() || rolls.front().code >= jump.from)
      return;
    constexpr std::int32_t sway = 40; // cm
    const auto far = spec::info(test->sensor).greatest;
    const bool along = (test->sensor == Variable::Ypos) == (*heading % (2 * quarter) == 0);
    const bool up = *heading < 2 * quarter;
    // The places it can reach: anywhere along its heading, and a little to the sides.
    for (const auto value : {0, -sway, sway, along && up ? far : sway, along && !up ? -far : -sway})
      if (!test->holds(value))
        return;
    std::string text(program_.text_of(span_of(comparison)));
    if (text.find_first_of("\r\n") != std::string::npos)
      return;
    auto& d = findings_.add(rules::ConstantComparison, span_of(comparison),
                            texts::NoRollLeadsThere(text));
    const auto at = text.find(spec::info(test->sensor).word);
    if (at == std::string::npos || along || test->holds(up ? far : -far))
      return;
    text.replace(at, spec::info(test->sensor).word.size(),
                 spec::info(test->sensor == Variable::Xpos ? Variable::Ypos : Variable::Xpos).word);
    d.help = texts::Write(text);
    d.fix = single_fix(d.help, span_of(comparison), text, Safety::Unsafe);
  }

  // ---- the minimum and maximum of readings

  /// `if speed < L then L = speed`, where L begins at 0.
  void check_extremes() {
    for (const auto& place : flow_.all(Statement::If)) {
      const auto condition = program_.as<IfView>(program_.statements[place.statement]);
      if (condition.second)
        continue;
      const auto& [left, relation, right] = condition.first;
      const auto orders = orders_of(condition.first);
      check_extreme(condition.first, left, right, orders);
      check_extreme(condition.first, right, left, mirrored(orders));
    }
  }

  /// The sensor, or the sensor whose value the letter always has.
  std::optional<Variable> sensor_behind(const Item& item) const {
    if (const auto sensor = sensor_in(program_, item))
      return sensor;
    const auto letter = letter_in(program_, item);
    if (!letter || settings_[*letter].size() != 1 || settings_[*letter][0].value == nullptr)
      return std::nullopt;
    return sensor_in(program_, *settings_[*letter][0].value);
  }

  void check_extreme(const Comparison& comparison, const Item& asked, const Item& kept,
                     Orders orders) {
    const auto sensor = sensor_behind(asked);
    const auto [letter, by] = shifted(kept);
    if (!sensor || letter == none || is_timer(*sensor))
      return;
    const auto& row = spec::info(*sensor);
    std::optional<std::int32_t> begin;
    bool keeps = false;
    for (const auto& setting : settings_[letter]) {
      if (setting.value == nullptr)
        return;
      const auto value = number(*setting.value);
      if (!value && sensor_behind(*setting.value) != sensor)
        return;
      keeps = keeps || !value;
      begin = value ? value : begin;
      if (value && value != begin)
        return;
    }
    const auto start = begin.value_or(0);
    const Bound bound{orders, std::int64_t{start} + by};
    if (!keeps || bound.holds(row.least) != bound.holds(row.greatest) ||
        bound.holds(row.least) != bound.holds(start) ||
        (start != row.least && start != row.greatest))
      return;
    const Item& name = letter_in(program_, asked) == letter ? asked : kept;
    const bool least = start == row.least;
    const auto text = program_.text_of(nodes_of(program_, name).front().span);
    findings_.add(rules::ConstantComparison, span_of(comparison),
                  (least ? texts::NeverLess : texts::NeverMore)(row.word, text, start),
                  texts::BeginWith(fmt::format("{} = {}", text, least ? row.greatest : row.least)));
  }

  const Settings& settings_;
};

} // namespace

void lint_meant(const Program& program, const Flow& flow, const Settings& settings,
                Findings& findings) {
  MeantPass(program, flow, settings, findings).run();
}

} // namespace orb::compiler
