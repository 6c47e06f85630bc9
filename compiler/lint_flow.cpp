#include "compiler/lint_passes.h"
#include "compiler/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace orb::compiler {
namespace {

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
    lint_loops(program_, flow_, findings_);
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
      if (node.kind == spec::Statement::Return)
        has_return_ = true;
      else if (spec::info(node.kind).after == spec::After::Waits)
        has_wait_ = true;
    }
    for (const auto& jump : flow_.jumps)
      has_call_ = has_call_ || jump.call;
  }

  enum class Calls : std::uint8_t { Enter, StepOver };

  /// Marks what can follow `start`, and returns what was not marked before, until the next call.
  const std::vector<std::uint32_t>& spread(std::uint32_t start, std::vector<std::uint8_t>& marks,
                                           Calls calls) {
    auto& found = found_;
    found.clear();
    const auto visit = [&](std::uint32_t to) {
      if (to < size_ && marks[to] == 0) {
        marks[to] = 1;
        found.push_back(to);
      }
    };
    visit(start);
    for (std::size_t n = 0; n < found.size(); ++n) {
      const auto at = found[n];
      const auto& code = flow_.code[at];
      if (code.falls)
        visit(at + 1);
      for (const auto& jump : flow_.jumps_of(code))
        if (!jump.call || calls == Calls::Enter)
          visit(jump.to);
    }
    return found;
  }

  void mark_reached() {
    reached_.assign(size_, 0);
    spread(0, reached_, Calls::Enter);
    // A line that is named as a wake-up line is an entry of its own.
    for (const auto& node : program_.statements)
      if (!node.error && node.kind == spec::Statement::Sleep) {
        const auto& root = program_.nodes[program_.as<SleepView>(node).line.value];
        if (root.kind == NodeKind::Number && root.value > 0)
          if (const auto* number = flow_.find(static_cast<std::uint32_t>(root.value)))
            spread(number->code, reached_, Calls::Enter);
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
      findings_.add(
          rules::UnreachableLine, line.number_span,
          i == first ? fmt::format("line {} is never reached", line.number)
                     : fmt::format("lines {} to {} are never reached", line.number, number_of(i)));
    }
  }

  // ---- subroutines

  void check_subroutines() {
    main_.assign(size_, 0);
    spread(0, main_, Calls::StepOver);
    inside_.assign(size_, 0);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (flow_.code[i].called && reached_[i] != 0)
        spread(i, inside_, Calls::StepOver);
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
          "put an `end` after this line");
      add_note(d, statement(i).span, "the subroutine begins here");
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
    spread(start, marks, Calls::StepOver);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (marks[i] != 0 && any_of_line(i, is_return))
        return true;
    return false;
  }

  /// The least number of calls that are open when a line runs. A `gosub` that already has four
  /// above it on every way stops the program.
  void check_depths() {
    constexpr std::uint32_t far = UINT8_MAX;
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
                          fmt::format("{} calls are already open here", most),
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
    std::vector<std::uint8_t> marks(size_, 0);
    for (std::size_t r = 0; r < routines.size(); ++r)
      for (const auto i : spread(routines[r], marks, Calls::StepOver)) {
        marks[i] = 0; // for the next routine
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
                    fmt::format("lines {} to {} run forever and never wait", number_of(jump.to),
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
    const auto after = spec::info(kind).after;
    return after == spec::After::Waits || after == spec::After::Ends;
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
  static constexpr std::uint32_t longest_loop = 1024; ///< lines

  const Program& program_;
  const Flow& flow_;
  Findings& findings_;
  std::uint32_t size_;
  bool has_return_ = false;
  bool has_call_ = false;
  bool has_wait_ = false;
  std::vector<std::uint32_t> found_; ///< by spread(), the last time
  std::vector<std::uint8_t> reached_;
  std::vector<std::uint8_t> main_;   ///< can run while no subroutine is open
  std::vector<std::uint8_t> inside_; ///< can run as part of a subroutine
};

} // namespace

void lint_flow(const Program& program, const Flow& flow, Findings& findings) {
  FlowRules(program, flow, findings).run();
}

} // namespace orb::compiler
