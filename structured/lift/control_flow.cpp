#include "structured/lift/control_flow.h"

#include "spec/limits.h"
#include "structured/text/rules.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>
#include <tuple>

namespace orb::structured::lifting {
namespace {

using compiler::StatementNode;
using spec::BasicError;

constexpr std::size_t most_loops = spec::value_of(spec::Limit::ForDepth);
constexpr std::size_t most_calls = spec::value_of(spec::Limit::GosubDepth);
constexpr std::size_t most_states = 200'000;

/// A step with its open loops and calls.
struct PathState {
  std::uint32_t step = 0;
  std::uint32_t loop_depth = 0;
  std::uint32_t call_depth = 0;
  std::array<std::uint32_t, most_loops> loops{}; ///< steps of `for`
  std::array<std::uint32_t, most_calls> calls{}; ///< steps of `gosub`

  friend bool operator<(const PathState& a, const PathState& b) {
    const auto all = [](const PathState& state) {
      return std::tie(state.step, state.loop_depth, state.call_depth, state.loops, state.calls);
    };
    return all(a) < all(b);
  }
};

/// A state and its first predecessor.
struct Reached {
  PathState state;
  std::uint32_t from = none;
};

/// Follows all paths of a program. Large because each kind of jump has a member that follows it,
/// and another that finds the line to blame if it fails.
class ControlFlowReader {
public:
  explicit ControlFlowReader(const compiler::Program& program)
      : program_(program), flow_(compiler::read_flow(program)) {}

  ControlFlow read() {
    collect_steps();
    find_targets();
    follow();
    std::sort(ways_.subroutines.begin(), ways_.subroutines.end());
    return std::move(ways_);
  }

private:
  const StatementNode& statement_of(const Step& step) const {
    return program_.statements[step.statement];
  }

  // ---- the steps

  void collect_steps() {
    for (const auto& code : flow_.code) {
      first_step_.push_back(ways_.end());
      const auto& statement = program_.statements[code.statement];
      add(code, code.statement);
      ways_.steps.back().begins_line = true;
      if (statement.then_branch == compiler::none)
        continue;
      add(code, statement.then_branch);
      if (statement.else_branch == compiler::none)
        continue;
      ways_.steps[first_step_.back()].otherwise = ways_.end();
      add(code, statement.else_branch);
    }
    first_step_.push_back(ways_.end());
  }

  void add(const compiler::Flow::Code& code, std::uint32_t statement) {
    auto& step = ways_.steps.emplace_back();
    step.statement = statement;
    step.line = code.line;
  }

  void find_targets() {
    for (std::uint32_t i = 0; i < flow_.code.size(); ++i)
      for (auto s = first_step_[i]; s < first_step_[i + 1]; ++s) {
        auto& step = ways_.steps[s];
        step.next = first_step_[i + 1];
        if (step.begins_line && statement_of(step).kind == spec::Statement::If) {
          if (step.otherwise == none)
            step.otherwise = step.next;
          continue;
        }
        for (const auto& item : program_.items_of(statement_of(step)))
          if (item.kind == compiler::ItemKind::Target) {
            const auto* number = flow_.find(item.value);
            step.targets.push_back(number == nullptr || number->code == compiler::none
                                       ? ways_.end()
                                       : first_step_[number->code]);
          }
      }
  }

  // ---- paths

  /// Breadth first, so that the path to each state is a shortest one.
  void follow() {
    if (ways_.steps.empty())
      return;
    in_main_.assign(ways_.steps.size(), false);
    reach(PathState{}, none);
    for (here_ = 0; here_ < states_.size() && !ways_.obstacle; ++here_)
      leave(PathState{states_[here_].state});
  }

  void reach(PathState state, std::uint32_t from) {
    if (state.step == ways_.end() || !seen_.insert(state).second)
      return;
    states_.push_back({state, from});
    if (!ways_.steps[state.step].reached)
      look_at(state);
    ways_.steps[state.step].reached = true;
    in_main_[state.step] = in_main_[state.step] || state.call_depth == 0;
    if (seen_.size() > most_states)
      stop(state, texts::TooManyWays(), texts::LetRun());
  }

  // ---- what structured programs cannot express

  void look_at(const PathState& state) {
    const auto& statement = statement_of(ways_.steps[state.step]);
    if (statement.kind == spec::Statement::Tron)
      stop(state, texts::TronNumbers(), texts::TakeOut());
    else if (statement.kind == spec::Statement::For)
      look_at_loop(state, program_.as<compiler::ForView>(statement));
    else if (statement.kind == spec::Statement::Sleep)
      look_at_sleep(state, program_.as<compiler::SleepView>(statement));
    else if (statement.kind == spec::Statement::Data)
      look_at_data(state, statement);
  }

  void look_at_loop(const PathState& state, const compiler::ForView& loop) {
    if (loop.variable.kind == compiler::ItemKind::Indexed)
      return stop(state, texts::CountsWithZ(), texts::CountWithLetter());
    if (loop.step == nullptr)
      return;
    const auto& step = program_.nodes[loop.step->value];
    const bool known = step.kind == compiler::NodeKind::Number ||
                       (step.kind == compiler::NodeKind::Negate &&
                        program_.nodes[loop.step->value - 1].kind == compiler::NodeKind::Number);
    if (!known)
      stop(state, texts::StepComputed(), texts::WriteStep());
  }

  void look_at_sleep(const PathState& state, const compiler::SleepView& sleep) {
    const auto& line = program_.nodes[sleep.line.value];
    const auto first = program_.lines[ways_.steps.front().line].number;
    const bool known = line.kind == compiler::NodeKind::Number &&
                       (line.value == 0 || static_cast<std::uint32_t>(line.value) == first);
    if (!known)
      stop(state, texts::WakesUpFirst(), texts::GiveSleep(first));
  }

  void look_at_data(const PathState& state, const StatementNode& statement) {
    for (const auto& item : program_.items_of(statement))
      for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
        const auto kind = program_.nodes[n].kind;
        const bool constant =
            kind == compiler::NodeKind::Number || kind == compiler::NodeKind::Group ||
            kind == compiler::NodeKind::Negate || kind == compiler::NodeKind::Binary;
        if (!constant)
          return stop(state, texts::DataComputed(), texts::WriteNumbers());
      }
  }

  void stop(const PathState& state, Message message, Message help) {
    if (!ways_.obstacle)
      ways_.obstacle =
          obstacle(statement_of(ways_.steps[state.step]).span, std::move(message), std::move(help));
  }

  void go(PathState state, std::uint32_t step) {
    state.step = step;
    reach(state, here_);
  }

  void leave(const PathState& state) {
    const auto& step = ways_.steps[state.step];
    const auto& statement = statement_of(step);
    switch (spec::info(statement.kind).form) {
    case spec::Form::Conditional:
      go(state, state.step + 1);
      go(state, step.otherwise);
      return;
    case spec::Form::Branch:
    case spec::Form::IndexedBranch: {
      for (const auto target : step.targets)
        calls(state.step) ? call(state, target) : go(state, target);
      return;
    }
    case spec::Form::Loop: begin_loop(state); return;
    case spec::Form::LoopEnd: end_loop(state); return;
    case spec::Form::Assignment:
    case spec::Form::Output:
    case spec::Form::Entry:
    case spec::Form::Values:
    case spec::Form::Variables:
    case spec::Form::Arguments:
      if (statement.kind == spec::Statement::Return)
        come_back(state);
      else if (spec::info(statement.kind).after != spec::After::Ends)
        go(state, step.next);
      return;
    }
  }

  void call(PathState state, std::uint32_t target) {
    if (state.call_depth == most_calls)
      return stop_at_call(state);
    if (std::find(ways_.subroutines.begin(), ways_.subroutines.end(), target) ==
        ways_.subroutines.end())
      ways_.subroutines.push_back(target);
    state.calls[state.call_depth++] = state.step;
    go(state, target);
  }

  void come_back(PathState state) {
    if (state.call_depth == 0)
      return stop_at_return(state);
    const auto caller = state.calls[--state.call_depth];
    state.calls[state.call_depth] = 0;
    go(state, ways_.steps[caller].next);
  }

  std::uint32_t variable_of(std::uint32_t loop) const {
    return program_.items_of(statement_of(ways_.steps[loop]))[0].value;
  }

  void begin_loop(PathState state) {
    const bool again = state.loop_depth > 0 &&
                       variable_of(state.loops[state.loop_depth - 1]) == variable_of(state.step);
    if (!again && state.loop_depth == most_loops)
      return stop_at_loop(state);
    state.loop_depth += again ? 0 : 1;
    state.loops[state.loop_depth - 1] = state.step;
    go(state, ways_.steps[state.step].next);
  }

  void end_loop(PathState state) {
    auto& step = ways_.steps[state.step];
    const auto loop = state.loop_depth > 0 ? state.loops[state.loop_depth - 1] : none;
    if (loop == none || variable_of(loop) != variable_of(state.step))
      return stop_at_next(state);
    if (step.loop != none && step.loop != loop) {
      const auto [first, second] = std::minmax(step.loop, loop);
      return stop(state, texts::TwoLoops(number_of(first), number_of(second)), texts::OwnNext());
    }
    step.loop = loop;
    go(state, ways_.steps[loop].next);
    state.loops[--state.loop_depth] = 0;
    go(state, step.next);
  }

  // ---- jump errors and the line to blame

  std::uint32_t number_of(std::uint32_t step) const {
    return program_.lines[ways_.steps[step].line].number;
  }

  static Message stops_with(BasicError error) { return texts::RobotStops(spec::info(error).text); }

  bool is(std::uint32_t step, spec::Statement kind) const {
    return statement_of(ways_.steps[step]).kind == kind;
  }
  bool calls(std::uint32_t step) const {
    const auto& statement = statement_of(ways_.steps[step]);
    return statement.kind == spec::Statement::Gosub ||
           statement.spelling == compiler::Spelling::OnGosub;
  }

  /// The last step on the path to the current state that crosses into, or out of, the text from
  /// `first` to `last`; none if the path does not cross.
  struct Crossing {
    std::uint32_t from = none;
    std::uint32_t to = none;
  };
  enum class Way : std::uint8_t { In, Out };
  std::optional<Crossing> last_crossing(std::uint32_t first, std::uint32_t last, Way way) const {
    const auto within = [&](std::uint32_t step) { return first <= step && step <= last; };
    for (auto at = here_; states_[at].from != none; at = states_[at].from) {
      const auto from = states_[states_[at].from].state.step;
      const auto to = states_[at].state.step;
      if (within(from) != within(to) && within(to) == (way == Way::In) && !calls(from) &&
          !is(from, spec::Statement::Return))
        return Crossing{from, to};
    }
    return std::nullopt;
  }

  /// The `next` below a `for` with the same variable, or none.
  std::uint32_t next_below(std::uint32_t loop) const {
    for (auto s = loop + 1; s < ways_.end(); ++s)
      if (is(s, spec::Statement::Next) && variable_of(s) == variable_of(loop))
        return s;
    return none;
  }
  /// The jump that left the innermost loop and so kept it open.
  std::optional<Crossing> way_out_of_loop(const PathState& state) const {
    const auto loop = state.loops[state.loop_depth - 1];
    const auto last = next_below(loop);
    return last == none ? std::nullopt : last_crossing(loop, last, Way::Out);
  }

  void blame(std::uint32_t step, Message message, Message help) {
    PathState state;
    state.step = step;
    stop(state, std::move(message), std::move(help));
  }
  void blame_way_out(const PathState& state, std::uint32_t from, Message then, BasicError error) {
    const auto loop = state.loops[state.loop_depth - 1];
    blame(from,
          texts::LeavesLoop(number_of(loop), std::move(then), number_of(state.step),
                            stops_with(error)),
          texts::LastValue(spec::letter_name(variable_of(loop)), number_of(next_below(loop))));
  }

  void stop_at_next(const PathState& state) {
    const auto name = spec::letter_name(variable_of(state.step));
    auto loop = state.step; // the `for` above it in the text
    while (loop > 0 &&
           !(is(loop, spec::Statement::For) && variable_of(loop) == variable_of(state.step)))
      --loop;
    const auto* const open = state.loops.data();
    const bool is_open = std::find(open, open + state.loop_depth, loop) != open + state.loop_depth;
    if (is_open) {
      if (const auto out = way_out_of_loop(state))
        return blame_way_out(state, out->from, texts::TheNext(name), BasicError::NextWithoutFor);
    } else if (is(loop, spec::Statement::For)) {
      if (const auto in = last_crossing(loop, state.step, Way::In); in && in->to != loop)
        return blame(in->from,
                     texts::EntersLoop(number_of(loop), name, number_of(state.step),
                                       stops_with(BasicError::NextWithoutFor)),
                     texts::JumpToLoop(number_of(loop)));
    }
    stop(state, texts::NextOfOther(name, stops_with(BasicError::NextWithoutFor)),
         texts::NoJumpsAcross());
  }

  void stop_at_loop(const PathState& state) {
    if (const auto out = way_out_of_loop(state))
      return blame_way_out(state, out->from, texts::NthLoop(most_loops + 1),
                           BasicError::ForDepthExceeded);
    stop(state, texts::LoopsTooDeep(most_loops + 1, stops_with(BasicError::ForDepthExceeded)),
         texts::LetLoopRun());
  }

  /// The steps called by a `gosub`.
  std::vector<std::uint32_t> called_steps() const {
    std::vector<std::uint32_t> called;
    for (std::uint32_t s = 0; s < ways_.end(); ++s)
      if (calls(s))
        called.insert(called.end(), ways_.steps[s].targets.begin(), ways_.steps[s].targets.end());
    std::sort(called.begin(), called.end());
    return called;
  }

  void stop_at_return(const PathState& state) {
    const auto called = called_steps();
    const auto above = std::upper_bound(called.begin(), called.end(), state.step);
    const auto in = above == called.begin() ? std::nullopt
                                            : last_crossing(*std::prev(above), state.step, Way::In);
    if (!in)
      return stop(state, texts::NoGosub(stops_with(BasicError::ReturnWithoutGosub)),
                  texts::EndAbove());
    const auto sub = number_of(*std::prev(above));
    const bool jumps = !ways_.steps[in->from].targets.empty();
    const auto& into = jumps ? texts::JumpsIntoSub : texts::RunsIntoSub;
    blame(in->from, into(sub, number_of(state.step), stops_with(BasicError::ReturnWithoutGosub)),
          jumps ? texts::Write(fmt::format("gosub {}", sub)) : texts::EndAboveLine(sub));
  }

  void stop_at_call(const PathState& state) {
    // The last jump from code reached only by calls to code of the main program.
    for (auto at = here_; states_[at].from != none; at = states_[at].from) {
      const auto from = states_[states_[at].from].state.step;
      if (is(from, spec::Statement::Goto) && !in_main_[from] && in_main_[states_[at].state.step])
        return blame(from,
                     texts::LeavesSub(most_calls + 1, number_of(state.step),
                                      stops_with(BasicError::GosubDepthExceeded)),
                     texts::LetSubRun());
    }
    stop(state, texts::SubsTooDeep(most_calls + 1, stops_with(BasicError::GosubDepthExceeded)),
         texts::LetSubsRun());
  }

  const compiler::Program& program_;
  compiler::Flow flow_;
  ControlFlow ways_;
  std::vector<std::uint32_t> first_step_; ///< of each line with a statement, and the end
  std::set<PathState> seen_;
  std::vector<Reached> states_; ///< in the order of discovery
  std::uint32_t here_ = 0;      ///< the current state
  std::vector<bool> in_main_;   ///< of each step: it runs with no call open
};

} // namespace

ControlFlow read_ways(const compiler::Program& program) {
  return ControlFlowReader(program).read();
}

Diagnostic obstacle(Span span, Message message, Message help) {
  return finding(rules::NotLiftable, span, std::move(message), std::move(help));
}

} // namespace orb::structured::lifting
