#include "structured/lift/ways.h"

#include "spec/limits.h"
#include "structured/text/rules.h"

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

/// A step and what is open there.
struct State {
  std::uint32_t step = 0;
  std::uint32_t loop_depth = 0;
  std::uint32_t call_depth = 0;
  std::array<std::uint32_t, most_loops> loops{}; ///< steps of `for`
  std::array<std::uint32_t, most_calls> calls{}; ///< steps of `gosub`

  friend bool operator<(const State& a, const State& b) {
    const auto all = [](const State& state) {
      return std::tie(state.step, state.loop_depth, state.call_depth, state.loops, state.calls);
    };
    return all(a) < all(b);
  }
};

/// A state and the one that it was first reached from.
struct Reached {
  State state;
  std::uint32_t from = none;
};

class Reader {
public:
  explicit Reader(const compiler::Program& program)
      : program_(program), flow_(compiler::read_flow(program)) {}

  Ways read() {
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

  // ---- the ways

  /// The nearest steps first, so that the way to each state is a shortest one.
  void follow() {
    if (ways_.steps.empty())
      return;
    in_main_.assign(ways_.steps.size(), false);
    reach(State{}, none);
    for (here_ = 0; here_ < states_.size() && !ways_.obstacle; ++here_)
      leave(State{states_[here_].state});
  }

  void reach(State state, std::uint32_t from) {
    if (state.step == ways_.end() || !seen_.insert(state).second)
      return;
    states_.push_back({state, from});
    if (!ways_.steps[state.step].reached)
      look_at(state);
    ways_.steps[state.step].reached = true;
    in_main_[state.step] = in_main_[state.step] || state.call_depth == 0;
    if (seen_.size() > most_states)
      stop(state, "the jumps mix loops and calls in too many ways to follow",
           "let loops run to their `next` and subroutines to their `return`");
  }

  // ---- what structured programs cannot say

  void look_at(const State& state) {
    const auto& statement = statement_of(ways_.steps[state.step]);
    if (statement.kind == spec::Statement::Tron)
      stop(state, "`tron` prints line numbers, which a structured program does not have",
           "take it out");
    else if (statement.kind == spec::Statement::For)
      look_at_loop(state, program_.as<compiler::ForView>(statement));
    else if (statement.kind == spec::Statement::Sleep)
      look_at_sleep(state, program_.as<compiler::SleepView>(statement));
    else if (statement.kind == spec::Statement::Data)
      look_at_data(state, statement);
  }

  void look_at_loop(const State& state, const compiler::ForView& loop) {
    if (loop.variable.kind == compiler::ItemKind::Indexed)
      return stop(state, "a structured loop counts with a variable, not with `Z`",
                  "count with a letter and set `Z` in the loop");
    if (loop.step == nullptr)
      return;
    const auto& step = program_.nodes[loop.step->value];
    const bool known = step.kind == compiler::NodeKind::Number ||
                       (step.kind == compiler::NodeKind::Negate &&
                        program_.nodes[loop.step->value - 1].kind == compiler::NodeKind::Number);
    if (!known)
      stop(state, "the step of a structured loop must be a literal number, not an expression",
           "write the number after `step`");
  }

  void look_at_sleep(const State& state, const compiler::SleepView& sleep) {
    const auto& line = program_.nodes[sleep.line.value];
    const auto first = program_.lines[ways_.steps.front().line].number;
    const bool known = line.kind == compiler::NodeKind::Number &&
                       (line.value == 0 || static_cast<std::uint32_t>(line.value) == first);
    if (!known)
      stop(state, "a structured program wakes up at its first line, or not at all",
           fmt::format("give `sleep` line 0 or line {}", first));
  }

  void look_at_data(const State& state, const StatementNode& statement) {
    for (const auto& item : program_.items_of(statement))
      for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
        const auto kind = program_.nodes[n].kind;
        const bool constant =
            kind == compiler::NodeKind::Number || kind == compiler::NodeKind::Group ||
            kind == compiler::NodeKind::Negate || kind == compiler::NodeKind::Binary;
        if (!constant)
          return stop(state, "`data` in a structured program takes numbers, not computed values",
                      "write the numbers");
      }
  }

  void stop(const State& state, std::string message, std::string help) {
    if (!ways_.obstacle)
      ways_.obstacle =
          obstacle(statement_of(ways_.steps[state.step]).span, std::move(message), std::move(help));
  }

  void go(State state, std::uint32_t step) {
    state.step = step;
    reach(state, here_);
  }

  void leave(const State& state) {
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

  void call(State state, std::uint32_t target) {
    if (state.call_depth == most_calls)
      return stop_at_call(state);
    if (std::find(ways_.subroutines.begin(), ways_.subroutines.end(), target) ==
        ways_.subroutines.end())
      ways_.subroutines.push_back(target);
    state.calls[state.call_depth++] = state.step;
    go(state, target);
  }

  void come_back(State state) {
    if (state.call_depth == 0)
      return stop_at_return(state);
    const auto caller = state.calls[--state.call_depth];
    state.calls[state.call_depth] = 0;
    go(state, ways_.steps[caller].next);
  }

  std::uint32_t variable_of(std::uint32_t loop) const {
    return program_.items_of(statement_of(ways_.steps[loop]))[0].value;
  }

  void begin_loop(State state) {
    const bool again = state.loop_depth > 0 &&
                       variable_of(state.loops[state.loop_depth - 1]) == variable_of(state.step);
    if (!again && state.loop_depth == most_loops)
      return stop_at_loop(state);
    state.loop_depth += again ? 0 : 1;
    state.loops[state.loop_depth - 1] = state.step;
    go(state, ways_.steps[state.step].next);
  }

  void end_loop(State state) {
    auto& step = ways_.steps[state.step];
    const auto loop = state.loop_depth > 0 ? state.loops[state.loop_depth - 1] : none;
    if (loop == none || variable_of(loop) != variable_of(state.step))
      return stop_at_next(state);
    if (step.loop != none && step.loop != loop) {
      const auto [first, second] = std::minmax(step.loop, loop);
      return stop(
          state,
          fmt::format(
              "this `next` sometimes belongs to the loop on line {} and sometimes to the one on "
              "line {}",
              number_of(first), number_of(second)),
          "give each loop its own `next`");
    }
    step.loop = loop;
    go(state, ways_.steps[loop].next);
    state.loops[--state.loop_depth] = 0;
    go(state, step.next);
  }

  // ---- errors about jumps, and the line that is to blame

  std::uint32_t number_of(std::uint32_t step) const {
    return program_.lines[ways_.steps[step].line].number;
  }

  static std::string error_text(BasicError error) {
    return fmt::format("the robot then stops with `{}`", spec::info(error).text);
  }

  bool is(std::uint32_t step, spec::Statement kind) const {
    return statement_of(ways_.steps[step]).kind == kind;
  }
  bool calls(std::uint32_t step) const {
    const auto& statement = statement_of(ways_.steps[step]);
    return statement.kind == spec::Statement::Gosub ||
           statement.spelling == compiler::Spelling::OnGosub;
  }

  /// The last step on the way to the state that is being left which goes from outside of the text
  /// from `first` to `last` into it, or out of it; none where the way does not.
  struct Crossing {
    std::uint32_t from = none;
    std::uint32_t to = none;
  };
  std::optional<Crossing> last_crossing(std::uint32_t first, std::uint32_t last, bool in) const {
    const auto within = [&](std::uint32_t step) { return first <= step && step <= last; };
    for (auto at = here_; states_[at].from != none; at = states_[at].from) {
      const auto from = states_[states_[at].from].state.step;
      const auto to = states_[at].state.step;
      if (within(from) != within(to) && within(to) == in && !calls(from) &&
          !is(from, spec::Statement::Return))
        return Crossing{from, to};
    }
    return std::nullopt;
  }

  /// The `next` below a `for` that counts in its variable, or none.
  std::uint32_t next_below(std::uint32_t loop) const {
    for (auto s = loop + 1; s < ways_.end(); ++s)
      if (is(s, spec::Statement::Next) && variable_of(s) == variable_of(loop))
        return s;
    return none;
  }
  /// The jump that left the innermost open loop, which therefore is still open.
  std::optional<Crossing> way_out_of_loop(const State& state) const {
    const auto loop = state.loops[state.loop_depth - 1];
    const auto last = next_below(loop);
    return last == none ? std::nullopt : last_crossing(loop, last, false);
  }

  void blame(std::uint32_t step, std::string message, std::string help) {
    State state;
    state.step = step;
    stop(state, std::move(message), std::move(help));
  }
  void blame_way_out(const State& state, std::uint32_t from, std::string_view then,
                     BasicError error) {
    const auto loop = state.loops[state.loop_depth - 1];
    blame(
        from,
        fmt::format("this jump leaves the loop on line {}, which stays open; at {} on line {}, {}",
                    number_of(loop), then, number_of(state.step), error_text(error)),
        fmt::format("set `{}` to its last value and jump to its `next` on line {}",
                    spec::letter_name(variable_of(loop)), number_of(next_below(loop))));
  }

  void stop_at_next(const State& state) {
    const auto name = spec::letter_name(variable_of(state.step));
    auto loop = state.step; // the `for` above in the text
    while (loop > 0 &&
           !(is(loop, spec::Statement::For) && variable_of(loop) == variable_of(state.step)))
      --loop;
    const auto* const open = state.loops.data();
    const bool is_open = std::find(open, open + state.loop_depth, loop) != open + state.loop_depth;
    if (is_open) {
      if (const auto out = way_out_of_loop(state))
        return blame_way_out(state, out->from, fmt::format("`next {}`", name),
                             BasicError::NextWithoutFor);
    } else if (is(loop, spec::Statement::For)) {
      if (const auto in = last_crossing(loop, state.step, true); in && in->to != loop)
        return blame(in->from,
                     fmt::format("this jump enters the loop on line {}, skipping its `for`; at "
                                 "`next {}` on line {}, {}",
                                 number_of(loop), name, number_of(state.step),
                                 error_text(BasicError::NextWithoutFor)),
                     fmt::format("jump to line {}, where the loop begins", number_of(loop)));
    }
    stop(state,
         fmt::format("this `next` can be reached when the innermost loop does not count with `{}`; "
                     "{}",
                     name, error_text(BasicError::NextWithoutFor)),
         "do not jump into or out of loops");
  }

  void stop_at_loop(const State& state) {
    if (const auto out = way_out_of_loop(state))
      return blame_way_out(state, out->from, fmt::format("the {}th open loop", most_loops + 1),
                           BasicError::ForDepthExceeded);
    stop(state,
         fmt::format("this can be the {}th loop open at once; {}", most_loops + 1,
                     error_text(BasicError::ForDepthExceeded)),
         "let each loop run to its `next`; do not leave it with `goto`");
  }

  /// The steps that some `gosub` calls.
  std::vector<std::uint32_t> called_steps() const {
    std::vector<std::uint32_t> called;
    for (std::uint32_t s = 0; s < ways_.end(); ++s)
      if (calls(s))
        called.insert(called.end(), ways_.steps[s].targets.begin(), ways_.steps[s].targets.end());
    std::sort(called.begin(), called.end());
    return called;
  }

  void stop_at_return(const State& state) {
    const auto called = called_steps();
    const auto above = std::upper_bound(called.begin(), called.end(), state.step);
    const auto in =
        above == called.begin() ? std::nullopt : last_crossing(*std::prev(above), state.step, true);
    if (!in)
      return stop(state,
                  fmt::format("this `return` can be reached without a `gosub`; {}",
                              error_text(BasicError::ReturnWithoutGosub)),
                  "put `end` above the subroutine");
    const auto sub = number_of(*std::prev(above));
    const bool jumps = !ways_.steps[in->from].targets.empty();
    blame(in->from,
          fmt::format("{} into the subroutine on line {} without a `gosub`; at its `return` on "
                      "line {} {}",
                      jumps ? "this jump goes" : "the program runs on from here", sub,
                      number_of(state.step), error_text(BasicError::ReturnWithoutGosub)),
          jumps ? fmt::format("write `gosub {}`", sub)
                : fmt::format("put a line with `end` above line {}", sub));
  }

  void stop_at_call(const State& state) {
    const auto fifth = fmt::format("{}th", most_calls + 1);
    // The last jump from where only calls lead to where the main program runs.
    for (auto at = here_; states_[at].from != none; at = states_[at].from) {
      const auto from = states_[states_[at].from].state.step;
      if (is(from, spec::Statement::Goto) && !in_main_[from] && in_main_[states_[at].state.step])
        return blame(from,
                     fmt::format("this jump leaves a subroutine, whose call stays open; at the {} "
                                 "open call on line {}, {}",
                                 fifth, number_of(state.step),
                                 error_text(BasicError::GosubDepthExceeded)),
                     "let the subroutine run to its `return`");
    }
    stop(state,
         fmt::format("this can be the {} call open at once; {}", fifth,
                     error_text(BasicError::GosubDepthExceeded)),
         "let each subroutine run to its `return`; do not leave it with `goto`");
  }

  const compiler::Program& program_;
  compiler::Flow flow_;
  Ways ways_;
  std::vector<std::uint32_t> first_step_; ///< of each line that holds a statement, and the end
  std::set<State> seen_;
  std::vector<Reached> states_; ///< in the order in which they were reached
  std::uint32_t here_ = 0;      ///< the one that is being left
  std::vector<bool> in_main_;   ///< of each step: it runs with no call open
};

} // namespace

Ways read_ways(const compiler::Program& program) {
  return Reader(program).read();
}

Diagnostic obstacle(Span span, std::string message, std::string help) {
  return finding(rules::NotLiftable, span, std::move(message), std::move(help));
}

} // namespace orb::structured::lifting
