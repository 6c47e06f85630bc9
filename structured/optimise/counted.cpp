#include "structured/optimise/counted.h"

#include "spec/limits.h"
#include "structured/analyse/line_facts.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

namespace orb::structured {
namespace {

using spec::Operator;

class LoopCounter {
public:
  LoopCounter(Code& code, const Identity& identity) : code_(code), identity_(identity) {}

  void run() {
    while (once())
      ;
  }

private:
  /// A loop `L: …; v = v + step; if v <= last then goto L`.
  struct CountedLoop {
    std::uint32_t begin = none; ///< the label
    std::uint32_t count = none; ///< the line that increments
    std::uint32_t test = none;
    std::uint32_t variable = none;
    std::uint32_t last = none; ///< a term
    compiler::Range end;       ///< the range of the tested bound
    std::int32_t step = 0;
  };

  bool once() {
    named_ = tidy(code_);
    at_ = lines_of_labels(code_);
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      if (auto loop = counted_by(i);
          loop && counts_alone(*loop) && can_be_left(*loop) && is_kept_open(*loop)) {
        write(*loop);
        return true;
      }
    return false;
  }

  std::optional<CountedLoop> counted_by(std::uint32_t i) {
    const auto& test = code_.lines[i];
    if (test.kind != LineKind::If || test.guard || named_[test.label] != 1 ||
        at_[test.label] >= i || code_.conditions[test.condition].glue != Glue::None)
      return std::nullopt;
    CountedLoop loop;
    loop.begin = at_[test.label];
    loop.test = i;
    loop.count = i - 1;
    const auto& count = code_.lines[loop.count];
    const auto sum = count.kind == LineKind::Let ? code_.terms[count.term] : Term{};
    const bool adds = sum.what == static_cast<int>(Operator::Add);
    if (sum.kind != TermKind::Binary || !reads_only(sum.left, count.variable) ||
        !code_.is_number(sum.right) || (!adds && sum.what != static_cast<int>(Operator::Subtract)))
      return std::nullopt;
    loop.variable = count.variable;
    const auto value = code_.terms[sum.right].value;
    loop.step = adds ? value : -value;
    loop.last = last_of(code_.conditions[test.condition].first, loop);
    return loop.last == none ? std::nullopt : std::optional(loop);
  }

  bool reads_only(std::uint32_t term, std::uint32_t variable) const {
    return code_.terms[term].kind == TermKind::Variable && code_.terms[term].left == variable;
  }

  /// The last counted value of a loop that continues while a relation holds, or none.
  std::uint32_t last_of(Relation relation, CountedLoop& loop) {
    if (!reads_only(relation.left, loop.variable)) {
      std::swap(relation.left, relation.right);
      std::swap(relation.left_range, relation.right_range);
      relation.comparison = mirrored(relation.comparison);
    }
    if (!reads_only(relation.left, loop.variable) || code_.terms[relation.right].effects != 0)
      return none;
    if (code_.is_number(relation.right))
      relation.right_range = compiler::Range::only(code_.terms[relation.right].value);
    loop.end = relation.right_range;
    using Limits = std::numeric_limits<std::int32_t>;
    const bool up = loop.step > 0;
    if (relation.comparison == (up ? Comparison::LessEqual : Comparison::GreaterEqual))
      return relation.right;
    if (relation.comparison != (up ? Comparison::Less : Comparison::Greater))
      return none;
    if (up ? loop.end.lo == Limits::min() : loop.end.hi == Limits::max())
      return none;
    return code_.binary(up ? Operator::Subtract : Operator::Add, relation.right, code_.number(1));
  }

  bool is(std::uint32_t i, LineKind kind) const {
    return i < code_.lines.size() && code_.lines[i].kind == kind;
  }

  /// True if only line `count` assigns the variable and the bound stays constant. Variables that
  /// share a letter count as one.
  bool counts_alone(const CountedLoop& loop) {
    flow_ = read_flow(code_);
    const auto is_set = [&](std::uint32_t variable) {
      bool found = false;
      const auto visit = [&](std::uint32_t v) {
        found = found || identity_(v) == identity_(variable);
      };
      for (auto i = loop.begin; i < loop.count; ++i) {
        each_write(code_, code_.lines[i], visit);
        if (const auto callee = callee_of(code_.lines[i]); callee != none)
          each_member(flow_.written[callee], visit);
      }
      return found;
    };
    bool good = !is_set(loop.variable);
    each_read(code_, loop.last, [&](std::uint32_t v) {
      good = good && identity_(v) != identity_(loop.variable) && !is_set(v);
    });
    return good;
  }

  /// True if the loop is entered only at its start, and every earlier exit can close it: the exit's
  /// target is reached only from there, and the variable is dead there.
  bool can_be_left(const CountedLoop& loop) {
    const auto& lines = code_.lines;
    std::vector<std::uint32_t> inside(code_.labels, 0); // references of each label from inside
    bool good = true;
    exits_.clear();
    for (auto i = loop.begin + 1; i < loop.test; ++i) {
      each_target(code_, lines[i], [&](std::uint32_t label) {
        ++inside[label];
        if (at_[label] == none || at_[label] <= loop.begin || at_[label] >= loop.test)
          exits_.push_back({i, label});
      });
      good = good && lines[i].kind != LineKind::Return;
    }
    for (auto i = loop.begin + 1; good && i < loop.count; ++i)
      if (lines[i].kind == LineKind::Label)
        good = inside[lines[i].label] == named_[lines[i].label];
    if (!good || exits_.empty())
      return good;
    const auto liveness = read_liveness(code_, flow_);
    for (const auto& [line, label] : exits_) {
      const auto at = at_[label];
      const bool apart = at != none && at > 0 && inside[label] == named_[label] &&
                         !falls_through(lines[at - 1]) && !is(at + 2, LineKind::Next);
      good = good && !lines[line].guard && apart;
      if (good)
        each_member(liveness.in[flow_.block_of_label[label]], [&](std::uint32_t v) {
          good = good && identity_(v) != identity_(loop.variable);
        });
    }
    using Limits = std::numeric_limits<std::int32_t>;
    const bool passes = loop.step > 0 ? loop.end.hi <= Limits::max() - loop.step
                                      : loop.end.lo >= Limits::min() - loop.step;
    return good && passes && !code_.variables[loop.variable].kept;
  }

  /// True if the robot already has a loop open with this variable: a `for` with it would replace
  /// that loop.
  bool is_kept_open(const CountedLoop& loop) const {
    const auto counts = [&](const CodeLine& line) {
      return identity_(line.variable) == identity_(loop.variable);
    };
    return depth_with(loop, [](const CodeLine&) { return true; }) <=
               spec::value_of(spec::Limit::ForDepth) &&
           depth_with(loop, counts) == 1;
  }

  /// The maximum number of open robot loops that satisfy `counts`, including this one.
  template <typename Counts>
  std::int64_t depth_with(const CountedLoop& loop, Counts counts) const {
    std::vector<std::int64_t> above(code_.routines.size(), 0); // loops open at calls of a routine
    std::int64_t deepest = 0;
    for (std::size_t round = 0; round < above.size(); ++round) {
      std::vector<std::int64_t> open = above;
      for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
        const auto& line = code_.lines[i];
        auto& here = open[line.routine];
        const bool begins = line.kind == LineKind::For && counts(line);
        const bool ends = line.kind == LineKind::Next && line.step != 0 && counts(line);
        here += begins || i == loop.begin ? 1 : 0;
        deepest = std::max(deepest, here);
        if (const auto callee = callee_of(line); callee != none)
          above[callee] = std::max(above[callee], here);
        here -= ends || i == loop.test ? 1 : 0;
      }
    }
    return deepest;
  }

  void write(const CountedLoop& loop) {
    auto& lines = code_.lines;
    const auto top = lines[loop.test].label;
    auto set = lines[loop.count]; // makes this round the last one
    set.term = loop.last;
    auto first = set;
    first.kind = LineKind::For;
    first.term = code_.read(loop.variable);
    first.end = loop.last;
    first.step = loop.step;
    first.label = top;
    auto& next = lines[loop.test];
    next = set;
    next.kind = LineKind::Next;
    next.label = top;
    next.step = loop.step;
    next.term = none;
    const auto end = next;
    lines[loop.count].kind = LineKind::Nothing;
    if (auto& start = lines[loop.begin - (loop.begin > 0 ? 1 : 0)];
        start.kind == LineKind::Let && start.variable == loop.variable && !start.guard) {
      first.term = start.term;
      first.origin = start.origin; // its value may stop the program
      first.expansion = start.expansion;
      start.kind = LineKind::Nothing;
    }
    lines.insert(lines.begin() + loop.begin, first);
    for (const auto& [line, label] : exits_)
      end_at(label, set, end);
  }

  /// Closes the loop first at a label that only exits reach.
  void end_at(std::uint32_t label, CodeLine set, CodeLine next) {
    const auto at = lines_of_labels(code_)[label];
    const auto& line = code_.lines[at];
    if (is(at + 2, LineKind::Next))
      return; // already done
    set.origin = next.origin = line.origin;
    set.routine = next.routine = line.routine;
    next.step = 0;
    code_.lines.insert(code_.lines.begin() + at + 1, {set, next});
  }

  Code& code_;
  const Identity& identity_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> exits_; ///< lines, and labels outside
  Flow flow_;
  std::vector<std::uint32_t> named_; ///< of each label: its references
  std::vector<std::uint32_t> at_;    ///< of each label: its line
};

} // namespace

void count_loops(Code& code, const Identity& identity) {
  LoopCounter(code, identity).run();
}

} // namespace orb::structured
