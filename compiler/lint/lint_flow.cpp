#include "compiler/lint/line_pass.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

/// Finds unreachable lines, faulty subroutines and busy loops. Large because each of these rules
/// has its own members, and all of them share the marks of the reachable lines.
class FlowRules : private LinePass {
public:
  using LinePass::LinePass;

  void run() {
    if (size_ == 0)
      return;
    found_.reserve(flow_.jumps.size());
    open_.reserve(flow_.jumps.size() + 1);
    mark_reached();
    check_unreachable();
    if (!returns().empty() || has_call())
      check_subroutines();
    check_busy_loops();
  }

private:
  // The state of a line:
  static constexpr std::uint8_t reached = 1;
  static constexpr std::uint8_t main = 2;   ///< can run outside any subroutine
  static constexpr std::uint8_t inside = 4; ///< can run inside a subroutine

  bool is(std::uint8_t mark, std::uint32_t code) const { return (marks_[code] & mark) == mark; }
  std::uint32_t line_of(std::uint32_t code) const { return flow_.code[code].line; }

  std::span<const Flow::Place> returns() const { return flow_.all(spec::Statement::Return); }
  bool has_call() const {
    return std::any_of(flow_.jumps.begin(), flow_.jumps.end(),
                       [](const Flow::Jump& jump) { return jump.call; });
  }

  enum class Calls : std::uint8_t { Enter, StepOver };

  /// Marks the lines reachable from `start`, and adds those that jump and were unmarked to
  /// `found_`.
  void spread(std::uint32_t start, std::uint8_t mark, std::vector<std::uint8_t>& marks,
              Calls calls) {
    open_.assign(1, start);
    while (!open_.empty()) {
      auto at = open_.back();
      open_.pop_back();
      for (; at < size_ && (marks[at] & mark) != mark; ++at) {
        marks[at] |= mark;
        const auto& code = flow_.code[at];
        const auto jumps = flow_.jumps_of(code);
        if (!jumps.empty())
          found_.push_back(at);
        for (const auto& jump : jumps)
          if (!jump.call || calls == Calls::Enter)
            open_.push_back(jump.to);
        if (!code.falls)
          break;
      }
    }
  }

  void mark_reached() {
    marks_.assign(size_, 0);
    spread(0, main | reached, marks_, Calls::StepOver);
    for (std::size_t i = 0; i < found_.size(); ++i) // the loop extends it
      for (const auto& jump : flow_.jumps_of(flow_.code[found_[i]]))
        if (jump.call)
          spread(jump.to, reached, marks_, Calls::Enter);
    // The literal wake-up line of a `sleep` is another entry point.
    for (const auto& sleep : flow_.all(spec::Statement::Sleep)) {
      const auto view = program_.as<SleepView>(program_.statements[sleep.statement]);
      const auto& root = program_.nodes[view.line.value];
      if (root.kind == NodeKind::Number && root.value > 0)
        if (const auto* number = flow_.find(static_cast<std::uint32_t>(root.value)))
          spread(number->code, reached, marks_, Calls::Enter);
    }
  }

  void check_unreachable() {
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (is(reached, i))
        continue;
      const auto first = i;
      while (i + 1 < size_ && !is(reached, i + 1))
        ++i;
      const auto& line = program_.lines[line_of(first)];
      if (!line.has_number() || flow_.is_taken(line.number, line_of(first)))
        continue;
      findings_.add(rules::UnreachableLine, line.number_span,
                    i == first ? texts::LineUnreachable(line.number)
                               : texts::LinesUnreachable(line.number, number_of(i)));
    }
  }

  // ---- subroutines

  void check_subroutines() {
    for (std::uint32_t i = 0; i < size_; ++i)
      if (flow_.code[i].called && is(reached, i)) {
        routines_.push_back(i);
        spread(i, inside, marks_, Calls::StepOver);
      }
    check_returns();
    check_runs_on();
    check_comes_back();
    if (!calls_nest())
      return;
    check_depths();
    check_recursion();
  }

  /// True if a subroutine calls another one.
  bool calls_nest() const {
    return std::any_of(flow_.jumps.begin(), flow_.jumps.end(),
                       [&](const Flow::Jump& jump) { return jump.call && is(inside, jump.from); });
  }

  void check_returns() {
    bool falls_into = false;
    for (const auto& place : returns()) {
      const auto& span = program_.statements[place.statement].span;
      if (is(main | inside, place.code))
        falls_into = true;
      else if (is(main, place.code))
        findings_
            .add(rules::ReturnWithoutGosub, span, texts::NoGosubLeadsHere(),
                 texts::EndProgramWith("end"))
            .fix = single_fix(texts::Write("end"), span, "end", Safety::Unsafe);
    }
    if (!falls_into)
      return;
    bool reported = false;
    for (std::uint32_t i = 1; i < size_; ++i) {
      const bool runs_in = flow_.code[i].called && is(main, i) && is(main, i - 1) &&
                           flow_.code[i - 1].falls && !is(inside, i - 1);
      if (!runs_in || !returns_from(i))
        continue;
      reported = true;
      auto& d = findings_.add(rules::FallIntoSubroutine, statement_of(i - 1).span,
                              texts::FallsIntoSubroutine(number_of(i)), texts::AddEndAfterThis());
      add_above(d, i, "end");
      add_note(d, statement_of(i).span, texts::SubroutineBeginsHere());
    }
    if (reported)
      return;
    for (const auto& jump : flow_.jumps)
      if (is(main, jump.from) && !is(inside, jump.from) && !jump.call && jump.to != none &&
          is(inside, jump.to) && returns_from(jump.to))
        findings_.add(rules::FallIntoSubroutine, program_.items[jump.item].span,
                      texts::PartOfSubroutine(number_of(jump.to)), texts::CallWithGosub());
  }

  /// Offers a line above a line of code, if a line number is free.
  void add_above(Diagnostic& d, std::uint32_t code, std::string_view word) const {
    const auto below = number_of(code);
    const auto above = number_of(code - 1);
    if (below < above + 2)
      return;
    const auto number = below > above + 5 ? above + 5 : above + 1;
    const auto at = program_.lines[line_of(code)].span.begin;
    const auto line = fmt::format("{} {}", number, word);
    d.help = texts::WriteAfterThis(line);
    d.fix = single_fix(d.help, {at, at}, line + "\n", Safety::Unsafe);
  }

  /// Finds subroutines that fall into the next one because `return` is missing. Two may share an
  /// end on purpose: then they are close together, or the first only sets values for the second.
  void check_runs_on() {
    for (std::size_t r = 1; r < routines_.size(); ++r) {
      const auto first = routines_[r - 1];
      const auto next = routines_[r];
      if (is(main, next - 1) || !is(inside, next - 1) || !flow_.code[next - 1].falls ||
          number_of(first) % round_number != 0 || number_of(next) % round_number != 0 ||
          !stands_apart(first, next) || !acts_alone(first, next) || !falls_to_return(next))
        continue;
      auto& d = findings_.add(rules::FallIntoSubroutine, statement_of(next - 1).span,
                              texts::RunsOn(number_of(first), number_of(next)));
      add_above(d, next, "return");
      add_note(d, statement_of(next).span, texts::SubroutineBeginsHere());
    }
  }

  /// True if the gap in line numbers before `next` is larger than any gap above it.
  bool stands_apart(std::uint32_t first, std::uint32_t next) const {
    std::uint32_t step = usual_step;
    for (auto i = first + 1; i < next; ++i)
      step = std::max(step, number_of(i) - number_of(i - 1));
    return number_of(next) - number_of(next - 1) > step;
  }

  /// True if the lines do more than set values, and do not jump away.
  bool acts_alone(std::uint32_t first, std::uint32_t next) const {
    bool acts = false;
    for (auto i = first; i < next; ++i) {
      if (flow_.code[i].ends)
        return false;
      for (const auto& jump : flow_.jumps_of(flow_.code[i]))
        if (!jump.call && (jump.to < first || jump.to >= next))
          return false;
      for (const auto& node : whole(i)) {
        if (node.error || is_return(node))
          return false;
        const auto form = spec::info(node.kind).form;
        acts = acts || form == spec::Form::Arguments || form == spec::Form::Output;
      }
    }
    return acts;
  }

  /// Finds calls of lines that never reach a `return`.
  void check_comes_back() {
    if (std::all_of(routines_.begin(), routines_.end(),
                    [&](std::uint32_t entry) { return falls_to_return(entry); }))
      return; // the usual case
    const auto back = lines_that_return();
    for (const auto& jump : flow_.jumps)
      if (jump.call && jump.to != none && is(reached, jump.from) && back[jump.to] == 0)
        add_never_returns(jump.from, jump);
  }

  /// True if the lines fall through to a `return` without a jump.
  bool falls_to_return(std::uint32_t at) const {
    while (!flow_.code[at].ends && flow_.code[at].falls && at + 1 < size_)
      ++at;
    return std::any_of(whole(at).begin(), whole(at).end(), is_return);
  }

  /// The lines that can reach a `return`, or a faulty statement that may become one.
  std::vector<std::uint8_t> lines_that_return() {
    std::vector<std::uint32_t> begins(size_ + 1, 0); // of the predecessors of each line
    const auto each_next = [&](std::uint32_t i, auto visit) {
      const auto& code = flow_.code[i];
      for (const auto& jump : flow_.jumps_of(code))
        if (!jump.call && jump.to != none)
          visit(jump.to);
      if (code.falls && i + 1 < size_)
        visit(i + 1);
    };
    for (std::uint32_t i = 0; i < size_; ++i)
      each_next(i, [&](std::uint32_t next) { ++begins[next]; });
    for (std::uint32_t i = 1; i <= size_; ++i)
      begins[i] += begins[i - 1];
    std::vector<std::uint32_t> leads(begins[size_]);
    for (std::uint32_t i = 0; i < size_; ++i)
      each_next(i, [&](std::uint32_t next) { leads[--begins[next]] = i; });
    std::vector<std::uint8_t> back(size_, 0);
    open_.clear();
    for (const auto& place : returns())
      open_.push_back(place.code);
    for (std::uint32_t i = 0; i < size_; ++i)
      if (std::any_of(whole(i).begin(), whole(i).end(),
                      [](const StatementNode& node) { return node.error.has_value(); }))
        open_.push_back(i);
    while (!open_.empty()) {
      const auto at = open_.back();
      open_.pop_back();
      if (back[at] != 0)
        continue;
      back[at] = 1;
      open_.insert(open_.end(), leads.begin() + begins[at], leads.begin() + begins[at + 1]);
    }
    return back;
  }

  void add_never_returns(std::uint32_t from, const Flow::Jump& jump) {
    auto last = jump.to;
    while (last + 1 < size_ && flow_.code[last].falls && !flow_.code[last + 1].called)
      ++last;
    const auto& end = statement_of(last);
    const bool ends = flow_.code[last].ends;
    if (ends && whole(from).size() > 1)
      return; // ends the program on purpose, after an error
    const auto number = number_of(last);
    auto& d = findings_.add(rules::NeverReturns, program_.items[jump.item].span,
                            texts::LineNeverReturns(number_of(jump.to)));
    if (flow_.code[last].falls) {
      d.help = texts::AddBelowLine("return", number);
    } else {
      d.help = texts::WriteReturnInstead(number, program_.text_of(end.span));
      d.fix = single_fix(d.help, end.span, "return", Safety::Unsafe);
    }
  }

  static bool is_return(const StatementNode& node) {
    return !node.error && node.kind == spec::Statement::Return;
  }

  bool returns_from(std::uint32_t start) {
    std::vector<std::uint8_t> marks(size_, 0);
    spread(start, 1, marks, Calls::StepOver);
    return std::any_of(returns().begin(), returns().end(),
                       [&](const Flow::Place& place) { return marks[place.code] != 0; });
  }

  /// Computes the least call depth at each line. A `gosub` that is always called at depth four
  /// stops the program.
  void check_depths() {
    constexpr std::uint8_t far = UINT8_MAX;
    constexpr auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::GosubDepth));
    std::vector<std::uint8_t> least(size_, far);
    std::vector<std::uint32_t> deeper; // calls from lines of this depth
    open_.assign(1, 0);
    for (std::uint8_t depth = 0; depth <= most; ++depth) {
      while (!open_.empty()) {
        auto i = open_.back();
        open_.pop_back();
        for (; i < size_ && least[i] > depth; ++i) {
          least[i] = depth;
          const auto& code = flow_.code[i];
          for (const auto& jump : flow_.jumps_of(code))
            (jump.call ? deeper : open_).push_back(jump.to);
          if (!code.falls)
            break;
        }
      }
      open_.swap(deeper);
    }
    for (std::uint32_t i = 0; i < size_; ++i)
      if (least[i] == most)
        for (const auto& jump : flow_.jumps_of(flow_.code[i]))
          if (jump.call) {
            findings_.add(rules::GosubDepth, statement_of(i).span, texts::CallsAreOpen(most),
                          texts::InlineSubroutine());
            break;
          }
  }

  /// Finds recursive subroutines.
  void check_recursion() {
    if (routines_.size() > most_routines)
      return;
    std::vector<std::vector<std::uint32_t>> calls(routines_.size());
    std::vector<std::uint8_t> marks;
    for (std::size_t r = 0; r < routines_.size(); ++r) {
      marks.assign(size_, 0);
      found_.clear();
      spread(routines_[r], 1, marks, Calls::StepOver);
      for (const auto i : found_)
        for (const auto& jump : flow_.jumps_of(flow_.code[i]))
          if (jump.call && jump.to != none)
            calls[r].push_back(routine_at(jump.to));
    }
    for (std::uint32_t r = 0; r < routines_.size(); ++r)
      if (calls_itself(r, calls))
        findings_.add(rules::GosubRecursion, statement_of(routines_[r]).span,
                      texts::CallsItself(number_of(routines_[r])), texts::UseALoop());
  }

  /// The index of the routine that begins at a line of code.
  std::uint32_t routine_at(std::uint32_t code) const {
    const auto at = std::lower_bound(routines_.begin(), routines_.end(), code);
    return static_cast<std::uint32_t>(at - routines_.begin());
  }

  static bool calls_itself(std::uint32_t routine,
                           const std::vector<std::vector<std::uint32_t>>& calls) {
    auto open = calls[routine];
    std::vector<bool> seen;
    while (!open.empty()) {
      const auto next = open.back();
      open.pop_back();
      if (next == routine)
        return true;
      seen.resize(calls.size());
      if (!seen[next])
        open.insert(open.end(), calls[next].begin(), calls[next].end());
      seen[next] = true;
    }
    return false;
  }

  // ---- waiting

  /// Finds a `goto` back to a line without an exit or a wait between.
  void check_busy_loops() {
    for (const auto& jump : flow_.jumps) {
      const auto& node = statement_of(jump.from);
      if (jump.to > jump.from || jump.from - jump.to > longest_loop ||
          node.kind != spec::Statement::Goto || !is(reached, jump.from) ||
          leaves_or_waits(jump.to, jump.from))
        continue;
      findings_.add(rules::BusyLoop, node.span,
                    texts::LoopsWithoutWaiting(number_of(jump.to), number_of(jump.from)),
                    texts::AddADelay());
    }
  }

  bool leaves_or_waits(std::uint32_t first, std::uint32_t last) const {
    for (auto i = first; i <= last; ++i) {
      if (statement_of(i).error)
        return true;
      for (const auto& jump : flow_.jumps_of(flow_.code[i])) {
        if (jump.call ? has_wait() : (jump.to < first || jump.to > last))
          return true;
      }
      if (flow_.code[i].waits || flow_.code[i].ends)
        return true;
      for (const auto& node : whole(i))
        if (node.error || reads_timer(node))
          return true;
    }
    return false;
  }

  bool has_wait() const {
    return std::any_of(flow_.code.begin(), flow_.code.end(),
                       [](const Flow::Code& code) { return code.waits; });
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

  /// Conventions: subroutines begin at round numbers, and line numbers grow by ten.
  static constexpr std::uint32_t round_number = 100;
  static constexpr std::uint32_t usual_step = 10;

  /// Above these limits, pairwise checks are skipped: no robot has room for such a program, and a
  /// linter must not take minutes.
  static constexpr std::size_t most_routines = 256;

  std::vector<std::uint32_t> routines_; ///< called lines, ascending
  std::vector<std::uint32_t> found_;    ///< result of spread()
  std::vector<std::uint32_t> open_;     ///< work list of spread()
  std::vector<std::uint8_t> marks_;     ///< by line
};

} // namespace

void lint_flow(const Program& program, const Flow& flow, Findings& findings) {
  FlowRules(program, flow, findings).run();
}

} // namespace orb::compiler
