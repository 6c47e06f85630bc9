#include "compiler/lint_passes.h"
#include "compiler/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace orb::compiler {
namespace {

constexpr std::uint32_t indexed = 25; // Z in masks and stacks of loop variables

std::uint32_t variable_of(const Item& item) {
  return item.kind == ItemKind::Letter ? item.value : indexed;
}

char name_of(std::uint32_t variable) {
  return static_cast<char>('A' + variable);
}

/// The open loops of a line, as far as they are the same on every way that leads there.
struct Loops {
  enum class State : std::uint8_t { Unvisited, Known, Unknown };
  State state = State::Unvisited;
  std::uint8_t count = 0;
  std::array<std::uint8_t, 4> variables{};

  friend bool operator==(const Loops&, const Loops&) = default;
};
static_assert(std::tuple_size_v<decltype(Loops::variables)> ==
              spec::value_of(spec::Limit::ForDepth));

class FlowRules {
public:
  FlowRules(const Program& program, const Flow& flow, Findings& findings)
      : program_(program), flow_(flow), findings_(findings),
        size_(static_cast<std::uint32_t>(flow.code.size())) {}

  void run() {
    if (size_ == 0)
      return;
    read_facts();
    mark_reached();
    check_unreachable();
    if (loops_set_ != 0 || loops_stepped_ != 0) {
      match_loops();
      follow_loops();
    }
    if (has_return_ || has_call_)
      check_subroutines();
    check_busy_loops();
  }

private:
  const StatementNode& statement(std::uint32_t code) const {
    return program_.statements[flow_.code[code].statement];
  }
  std::uint32_t line_of(std::uint32_t code) const { return flow_.code[code].line; }
  std::uint32_t number_of(std::uint32_t code) const { return program_.lines[line_of(code)].number; }
  /// The variable of a `for`.
  std::uint32_t counter_of(const StatementNode& node) const {
    return variable_of(program_.as<ForView>(node).variable);
  }
  /// The variable of a `next`.
  std::uint32_t stepped_by(const StatementNode& node) const {
    return variable_of(program_.as<NextView>(node).variable);
  }

  /// Whether the statement of a line, or one in its branches, is one that `test` holds for.
  template <typename Test>
  bool any_of_line(std::uint32_t code, Test test) const {
    const auto whole = program_.whole(statement(code));
    return std::any_of(whole.begin(), whole.end(), test);
  }

  void read_facts() {
    for (const auto& node : program_.statements) {
      if (node.error)
        continue;
      if (node.kind == spec::Statement::For)
        loops_set_ |= std::uint32_t{1} << counter_of(node);
      else if (node.kind == spec::Statement::Next)
        loops_stepped_ |= std::uint32_t{1} << stepped_by(node);
      else if (node.kind == spec::Statement::Return)
        has_return_ = true;
      else if (node.kind == spec::Statement::Delay || node.kind == spec::Statement::Input)
        has_wait_ = true;
    }
    for (const auto& jump : flow_.jumps)
      has_call_ = has_call_ || jump.call;
  }

  /// Marks what can follow `start` with `mark`; calls are entered or stepped over.
  template <typename IntoCalls>
  void spread(std::uint32_t start, std::vector<std::uint8_t>& marks, IntoCalls into_calls) {
    if (start == none || marks[start] != 0)
      return;
    std::vector<std::uint32_t> open{start};
    marks[start] = 1;
    const auto visit = [&](std::uint32_t to) {
      if (to < size_ && marks[to] == 0) {
        marks[to] = 1;
        open.push_back(to);
      }
    };
    while (!open.empty()) {
      const auto at = open.back();
      open.pop_back();
      const auto& code = flow_.code[at];
      if (code.falls)
        visit(at + 1);
      for (const auto& jump : flow_.jumps_of(code))
        if (!jump.call || into_calls)
          visit(jump.to);
    }
  }

  void mark_reached() {
    reached_.assign(size_, 0);
    spread(0, reached_, true);
    // A line that is named as a wake-up line is an entry of its own.
    for (const auto& node : program_.statements)
      if (!node.error && node.kind == spec::Statement::Sleep) {
        const auto& root = program_.nodes[program_.as<SleepView>(node).line.value];
        if (root.kind == NodeKind::Number && root.value > 0)
          if (const auto* number = flow_.find(static_cast<std::uint32_t>(root.value)))
            spread(number->code, reached_, true);
      }
  }

  void check_unreachable() {
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (reached_[i] != 0)
        continue;
      const auto first = i;
      while (i + 1 < size_ && reached_[i + 1] == 0)
        ++i;
      const auto& line = program_.lines[line_of(first)];
      if (!line.has_number())
        continue;
      findings_.add(rules::UnreachableLine, line.number_span,
                    i == first
                        ? fmt::format("no way leads to line {}", line.number)
                        : fmt::format("no way leads to lines {} to {}", line.number, number_of(i)));
    }
  }

  // ---- loops

  /// Pairs `for` and `next` as they stand in the text and looks for jumps that leave a pair.
  void match_loops() {
    struct Pair {
      std::uint32_t begin;
      std::uint32_t end;
      std::uint32_t outer;
    };
    std::vector<Pair> pairs;
    std::vector<std::uint32_t> open;
    std::vector<std::uint32_t> innermost(size_, none);
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& node = statement(i);
      if (!node.error && node.kind == spec::Statement::For) {
        open.push_back(static_cast<std::uint32_t>(pairs.size()));
        pairs.push_back({i, none, open.size() > 1 ? open[open.size() - 2] : none});
      }
      innermost[i] = open.empty() ? none : open.back();
      if (!node.error && node.kind == spec::Statement::Next) {
        const auto variable = stepped_by(node);
        while (!open.empty() && counter_of(statement(pairs[open.back()].begin)) != variable)
          open.pop_back();
        if (!open.empty()) {
          pairs[open.back()].end = i;
          open.pop_back();
        }
      }
    }
    for (std::uint32_t i = 0; i < size_; ++i) {
      auto pair = innermost[i];
      while (pair != none && (pairs[pair].end == none || i > pairs[pair].end))
        pair = pairs[pair].outer;
      if (pair == none || flow_.code[i].jumps_begin == flow_.code[i].jumps_end)
        continue;
      for (const auto& jump : flow_.jumps_of(flow_.code[i]))
        if (!jump.call && jump.to != none &&
            (jump.to < pairs[pair].begin || jump.to > pairs[pair].end)) {
          auto& d = findings_.add(
              rules::JumpOutOfFor, program_.items[jump.item].span,
              fmt::format("line {} lies outside of the loop, which stays open", number_of(jump.to)),
              "set the loop variable to its end value and go to the `next`");
          d.notes.push_back({statement(pairs[pair].begin).span, "the loop"});
        }
    }
    for (const auto& node : program_.statements)
      if (!node.error && node.kind == spec::Statement::For) {
        const auto variable = counter_of(node);
        if ((loops_stepped_ >> variable & 1) == 0)
          findings_.add(rules::ForWithoutNext, node.span,
                        fmt::format("the loop has no `next {}`", name_of(variable)));
      }
  }

  std::uint32_t line_of_span(Span span) const {
    const auto next = std::upper_bound(
        program_.lines.begin(), program_.lines.end(), span.begin,
        [](std::uint32_t offset, const Line& line) { return offset < line.span.begin; });
    return static_cast<std::uint32_t>(next - program_.lines.begin()) - 1;
  }

  /// Carries the open loops along every way. What differs between two ways is unknown.
  void follow_loops() {
    std::vector<Loops> at(size_);
    std::vector<std::uint32_t> work;
    const bool subroutines_loop = loops_in_subroutines();
    const auto flow_to = [&](std::uint32_t to, const Loops& loops) {
      if (to >= size_)
        return;
      auto joined = loops;
      if (at[to].state != Loops::State::Unvisited && at[to] != loops)
        joined = unknown();
      if (joined == at[to])
        return;
      at[to] = joined;
      work.push_back(to);
    };
    flow_to(0, Loops{Loops::State::Known, 0, {}});
    for (std::uint32_t i = 1; i < size_; ++i)
      if (flow_.code[i].called)
        flow_to(i, unknown()); // who calls, and out of which loops, is not followed
    while (!work.empty()) {
      const auto i = work.back();
      work.pop_back();
      const auto& code = flow_.code[i];
      bool stops = false;
      auto after = step(i, at[i], stops);
      if (stops)
        continue;
      for (const auto& jump : flow_.jumps_of(code)) {
        if (!jump.call)
          flow_to(jump.to, after);
        else if (subroutines_loop)
          after = unknown();
      }
      if (code.falls)
        flow_to(i + 1, after);
    }
    for (std::uint32_t i = 0; i < size_; ++i)
      report_loops(i, at[i]);
  }

  static Loops unknown() { return {Loops::State::Unknown, 0, {}}; }

  bool loops_in_subroutines() {
    std::vector<std::uint8_t> inside(size_, 0);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (flow_.code[i].called)
        spread(i, inside, true);
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (inside[i] != 0 && any_of_line(i, is_loop_part))
        return true;
    }
    return false;
  }

  static bool is_loop_part(const StatementNode& node) {
    return !node.error && (node.kind == spec::Statement::For || node.kind == spec::Statement::Next);
  }

  /// The loops behind line `i`; `stops` where the line ends the program for certain.
  Loops step(std::uint32_t i, Loops loops, bool& stops) const {
    const auto& node = statement(i);
    if (node.error)
      return loops;
    if (node.kind == spec::Statement::If)
      return any_of_line(i, is_loop_part) ? unknown() : loops;
    if (loops.state != Loops::State::Known)
      return loops;
    if (node.kind == spec::Statement::For) {
      const auto variable = static_cast<std::uint8_t>(counter_of(node));
      if (loops.count > 0 && loops.variables[loops.count - 1] == variable)
        return loops; // the innermost loop is begun anew
      if (loops.count == loops.variables.size()) {
        stops = true;
        return loops;
      }
      loops.variables[loops.count++] = variable;
    } else if (node.kind == spec::Statement::Next) {
      const auto variable = stepped_by(node);
      if (loops.count == 0 || loops.variables[loops.count - 1] != variable) {
        stops = true;
        return loops;
      }
      loops.variables[--loops.count] = 0;
    }
    return loops;
  }

  void report_loops(std::uint32_t i, const Loops& loops) {
    const auto& node = statement(i);
    if (!is_loop_part(node))
      return;
    if (node.kind == spec::Statement::Next && (loops_set_ >> stepped_by(node) & 1) == 0) {
      findings_.add(rules::NextWithoutFor, node.span,
                    fmt::format("there is no `for {}`", name_of(stepped_by(node))));
      return;
    }
    bool stops = false;
    step(i, loops, stops);
    if (!stops)
      return;
    if (node.kind == spec::Statement::For)
      findings_.add(rules::ForDepth, node.span,
                    fmt::format("{} loops are open here already", loops.count),
                    "end one of them first, or compute two counters from one");
    else if (loops.count == 0)
      findings_.add(rules::NextWithoutFor, node.span, "no loop is open here");
    else
      findings_.add(
          rules::NextWithoutFor, node.span,
          fmt::format("the innermost loop counts in `{}`",
                      name_of(loops.variables[loops.count - 1])),
          fmt::format("end it first: `next {}`", name_of(loops.variables[loops.count - 1])));
  }

  // ---- subroutines

  void check_subroutines() {
    main_.assign(size_, 0);
    spread(0, main_, false);
    inside_.assign(size_, 0);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (flow_.code[i].called && reached_[i] != 0)
        spread(i, inside_, false);
    check_returns();
    check_depths();
    check_recursion();
  }

  void check_returns() {
    bool falls_into = false;
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (main_[i] == 0)
        continue;
      for (const auto& node : program_.whole(statement(i))) {
        if (!is_return(node))
          continue;
        if (inside_[i] == 0)
          findings_.add(rules::ReturnWithoutGosub, node.span, "no `gosub` leads to this `return`",
                        "end the program with `end`");
        else
          falls_into = true;
      }
    }
    if (!falls_into)
      return;
    bool reported = false;
    for (std::uint32_t i = 1; i < size_; ++i) {
      const bool runs_in = flow_.code[i].called && main_[i] != 0 && main_[i - 1] != 0 &&
                           flow_.code[i - 1].falls && inside_[i - 1] == 0;
      if (!runs_in || !returns_from(i))
        continue;
      reported = true;
      auto& d = findings_.add(
          rules::FallIntoSubroutine, statement(i - 1).span,
          fmt::format("the program runs on into the subroutine at line {}", number_of(i)),
          "put an `end` behind this line");
      d.notes.push_back({statement(i).span, "the subroutine begins here"});
    }
    if (reported)
      return;
    for (std::uint32_t i = 0; i < size_; ++i)
      if (main_[i] != 0 && inside_[i] == 0)
        for (const auto& jump : flow_.jumps_of(flow_.code[i]))
          if (!jump.call && jump.to != none && inside_[jump.to] != 0 && returns_from(jump.to))
            findings_.add(rules::FallIntoSubroutine, program_.items[jump.item].span,
                          fmt::format("line {} belongs to a subroutine and leads to its `return`",
                                      number_of(jump.to)),
                          "call it with `gosub`");
  }

  static bool is_return(const StatementNode& node) {
    return !node.error && node.kind == spec::Statement::Return;
  }

  bool returns_from(std::uint32_t start) {
    std::vector<std::uint8_t> marks(size_, 0);
    spread(start, marks, false);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (marks[i] != 0 && any_of_line(i, is_return))
        return true;
    return false;
  }

  /// The least number of calls that are open when a line runs. A `gosub` that already has four
  /// above it on every way stops the program.
  void check_depths() {
    constexpr std::uint32_t far = 0xFF;
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GosubDepth));
    std::vector<std::uint32_t> least(size_, far);
    std::vector<std::vector<std::uint32_t>> levels(most + 2);
    levels[0].push_back(0);
    least[0] = 0;
    for (std::uint32_t depth = 0; depth <= most; ++depth) {
      auto& open = levels[depth];
      while (!open.empty()) {
        const auto i = open.back();
        open.pop_back();
        if (least[i] != depth)
          continue;
        const auto visit = [&](std::uint32_t to, std::uint32_t at) {
          if (to < size_ && least[to] > at) {
            least[to] = at;
            levels[at].push_back(to);
          }
        };
        if (flow_.code[i].falls)
          visit(i + 1, depth);
        for (const auto& jump : flow_.jumps_of(flow_.code[i]))
          visit(jump.to, jump.call ? depth + 1 : depth);
      }
    }
    for (std::uint32_t i = 0; i < size_; ++i)
      if (least[i] == most)
        for (const auto& jump : flow_.jumps_of(flow_.code[i]))
          if (jump.call) {
            findings_.add(rules::GosubDepth, statement(i).span,
                          fmt::format("{} calls are open here already", most),
                          "put the subroutine's lines here, or call it from further up");
            break;
          }
  }

  /// Looks for subroutines that reach a call of themselves.
  void check_recursion() {
    std::vector<std::uint32_t> routines;
    std::vector<std::uint32_t> index(size_, none);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (flow_.code[i].called && reached_[i] != 0) {
        index[i] = static_cast<std::uint32_t>(routines.size());
        routines.push_back(i);
      }
    if (routines.empty() || routines.size() > most_routines)
      return;
    std::vector<std::vector<std::uint32_t>> calls(routines.size());
    for (std::size_t r = 0; r < routines.size(); ++r) {
      std::vector<std::uint8_t> marks(size_, 0);
      spread(routines[r], marks, false);
      for (std::uint32_t i = 0; i < size_; ++i)
        if (marks[i] != 0)
          for (const auto& jump : flow_.jumps_of(flow_.code[i]))
            if (jump.call && jump.to != none && index[jump.to] != none)
              calls[r].push_back(index[jump.to]);
    }
    for (std::size_t r = 0; r < routines.size(); ++r) {
      std::vector<std::uint8_t> seen(routines.size(), 0);
      std::vector<std::uint32_t> open = calls[r];
      bool recursive = false;
      while (!open.empty() && !recursive) {
        const auto next = open.back();
        open.pop_back();
        recursive = next == r;
        if (seen[next] == 0) {
          seen[next] = 1;
          open.insert(open.end(), calls[next].begin(), calls[next].end());
        }
      }
      if (recursive)
        findings_.add(rules::GosubRecursion, statement(routines[r]).span,
                      fmt::format("the subroutine at line {} calls itself", number_of(routines[r])),
                      "only 4 calls can be open at once; use a loop");
    }
  }

  // ---- waiting

  /// A `goto` back to a line, with no way out between and nothing that waits.
  void check_busy_loops() {
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& node = statement(i);
      if (node.error || node.kind != spec::Statement::Goto || reached_[i] == 0)
        continue;
      const auto& jump = flow_.jumps[flow_.code[i].jumps_begin];
      if (jump.to > i || i - jump.to > longest_loop || leaves_or_waits(jump.to, i))
        continue;
      findings_.add(rules::BusyLoop, node.span,
                    fmt::format("lines {} to {} run for ever and never wait", number_of(jump.to),
                                number_of(i)),
                    "add a `delay`");
    }
  }

  bool leaves_or_waits(std::uint32_t first, std::uint32_t last) const {
    for (auto i = first; i <= last; ++i) {
      if (statement(i).error)
        return true;
      for (const auto& jump : flow_.jumps_of(flow_.code[i])) {
        if (jump.call ? has_wait_ : (jump.to < first || jump.to > last))
          return true;
      }
      if (any_of_line(i, [&](const StatementNode& node) {
            return node.error || stops_or_waits(node.kind) || reads_timer(node);
          }))
        return true;
    }
    return false;
  }

  static bool stops_or_waits(spec::Statement kind) {
    return kind == spec::Statement::Delay || kind == spec::Statement::Input ||
           kind == spec::Statement::Sleep || kind == spec::Statement::End ||
           kind == spec::Statement::Return || kind == spec::Statement::Reset;
  }

  bool reads_timer(const StatementNode& node) const {
    for (const auto& part : program_.items_of(node)) {
      if (part.kind != ItemKind::Expression && part.kind != ItemKind::Character)
        continue;
      for (auto n = program_.nodes[part.value].first; n <= part.value; ++n)
        if (program_.nodes[n].kind == NodeKind::System &&
            program_.nodes[n].what <= static_cast<std::uint8_t>(spec::Variable::TimerC))
          return true;
    }
    return false;
  }

  /// Beyond these the checks that look at pairs of lines are left out: no area of the robot holds
  /// such a program, and a linter must not take minutes over it.
  static constexpr std::size_t most_routines = 256;
  static constexpr std::uint32_t longest_loop = 1024;

  const Program& program_;
  const Flow& flow_;
  Findings& findings_;
  std::uint32_t size_;
  std::uint32_t loops_set_ = 0;     ///< letters that some `for` counts in
  std::uint32_t loops_stepped_ = 0; ///< letters that some `next` steps
  bool has_return_ = false;
  bool has_call_ = false;
  bool has_wait_ = false;
  std::vector<std::uint8_t> reached_;
  std::vector<std::uint8_t> main_;   ///< can run while no subroutine is open
  std::vector<std::uint8_t> inside_; ///< can run as part of a subroutine
};

} // namespace

void lint_flow(const Program& program, const Flow& flow, Findings& findings) {
  FlowRules(program, flow, findings).run();
}

} // namespace orb::compiler
