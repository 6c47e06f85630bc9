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

class Reader {
public:
  explicit Reader(const compiler::Program& program)
      : program_(program), flow_(compiler::read_flow(program)) {}

  Ways read() {
    collect_steps();
    find_targets();
    follow();
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

  void follow() {
    if (ways_.steps.empty())
      return;
    reach(State{});
    while (!work_.empty() && !ways_.obstacle) {
      const auto state = work_.back();
      work_.pop_back();
      leave(state);
    }
    std::sort(ways_.subroutines.begin(), ways_.subroutines.end());
  }

  void reach(State state) {
    if (state.step == ways_.end() || !seen_.insert(state).second)
      return;
    if (!ways_.steps[state.step].reached)
      look_at(state);
    ways_.steps[state.step].reached = true;
    work_.push_back(state);
    if (seen_.size() > most_states)
      stop(state, "the jumps mix loops and calls in too many ways to follow",
           "let loops run to their `next` and subroutines to their `return`");
  }

  // ---- what structured programs cannot say

  void look_at(const State& state) {
    const auto& statement = statement_of(ways_.steps[state.step]);
    if (statement.kind == spec::Statement::Tron)
      stop(state, "`tron` prints the numbers of lines, which a structured program does not have",
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
      return stop(state, "a structured loop counts in a variable, not in `Z`",
                  "count in a letter and set `Z` in the loop");
    if (loop.step == nullptr)
      return;
    const auto& step = program_.nodes[loop.step->value];
    const bool known = step.kind == compiler::NodeKind::Number ||
                       (step.kind == compiler::NodeKind::Negate &&
                        program_.nodes[loop.step->value - 1].kind == compiler::NodeKind::Number);
    if (!known)
      stop(state, "the step of a structured loop is a number, not computed",
           "write the number after `step`");
  }

  void look_at_sleep(const State& state, const compiler::SleepView& sleep) {
    const auto& line = program_.nodes[sleep.line.value];
    const auto first = program_.lines[ways_.steps.front().line].number;
    const bool known = line.kind == compiler::NodeKind::Number &&
                       (line.value == 0 || static_cast<std::uint32_t>(line.value) == first);
    if (!known)
      stop(state, "a structured program wakes into its first line, or not at all",
           fmt::format("sleep until line 0 or line {}", first));
  }

  void look_at_data(const State& state, const StatementNode& statement) {
    for (const auto& item : program_.items_of(statement))
      for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
        const auto kind = program_.nodes[n].kind;
        const bool constant =
            kind == compiler::NodeKind::Number || kind == compiler::NodeKind::Group ||
            kind == compiler::NodeKind::Negate || kind == compiler::NodeKind::Binary;
        if (!constant)
          return stop(state, "`data` of a structured program holds numbers, not computed values",
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
    reach(state);
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
      const bool calls = statement.kind == spec::Statement::Gosub ||
                         statement.spelling == compiler::Spelling::OnGosub;
      for (const auto target : step.targets)
        calls ? call(state, target) : go(state, target);
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
      return stop(state,
                  fmt::format("this call can be the {}th one open at once; the robot then stops "
                              "with `{}`",
                              most_calls + 1, spec::info(BasicError::GosubDepthExceeded).text),
                  "let each subroutine run to its `return`; do not leave it by `goto`");
    if (std::find(ways_.subroutines.begin(), ways_.subroutines.end(), target) ==
        ways_.subroutines.end())
      ways_.subroutines.push_back(target);
    state.calls[state.call_depth++] = state.step;
    go(state, target);
  }

  void come_back(State state) {
    if (state.call_depth == 0)
      return stop(state,
                  fmt::format("this `return` can be reached without a `gosub`; the robot then "
                              "stops with `{}`",
                              spec::info(BasicError::ReturnWithoutGosub).text),
                  "put `end` above the subroutine");
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
      return stop(state,
                  fmt::format("this loop can be the {}th one open at once; the robot then stops "
                              "with `{}`",
                              most_loops + 1, spec::info(BasicError::ForDepthExceeded).text),
                  "let each loop run to its `next`; do not leave it by `goto`");
    state.loop_depth += again ? 0 : 1;
    state.loops[state.loop_depth - 1] = state.step;
    go(state, ways_.steps[state.step].next);
  }

  void end_loop(State state) {
    auto& step = ways_.steps[state.step];
    const auto name = spec::letter_name(variable_of(state.step));
    const auto loop = state.loop_depth > 0 ? state.loops[state.loop_depth - 1] : none;
    if (loop == none || variable_of(loop) != variable_of(state.step))
      return stop(state,
                  fmt::format("this `next` can be reached when the innermost loop does not count "
                              "in `{}`; the robot then stops with `{}`",
                              name, spec::info(BasicError::NextWithoutFor).text),
                  "do not jump into or out of loops");
    if (step.loop != none && step.loop != loop)
      return stop(state,
                  fmt::format("this `next` belongs to the loop of line {} one time and to that of "
                              "line {} another time",
                              number_of(step.loop), number_of(loop)),
                  "give each loop a `next` of its own");
    step.loop = loop;
    go(state, ways_.steps[loop].next);
    state.loops[--state.loop_depth] = 0;
    go(state, step.next);
  }

  std::uint32_t number_of(std::uint32_t step) const {
    return program_.lines[ways_.steps[step].line].number;
  }

  const compiler::Program& program_;
  compiler::Flow flow_;
  Ways ways_;
  std::vector<std::uint32_t> first_step_; ///< of each line that holds a statement, and the end
  std::set<State> seen_;
  std::vector<State> work_;
};

} // namespace

Ways read_ways(const compiler::Program& program) {
  return Reader(program).read();
}

Diagnostic obstacle(Span span, std::string message, std::string help) {
  return finding(rules::NotLiftable, span, std::move(message), std::move(help));
}

} // namespace orb::structured::lifting
