#include "structured/optimise/counted.h"

#include "spec/limits.h"
#include "structured/analyse/line_facts.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace orb::structured {
namespace {

using spec::Operator;

class LoopCounter {
public:
  explicit LoopCounter(Code& code) : code_(code) {}

  bool run() {
    bool any = false;
    while (once())
      any = true;
    return any;
  }

private:
  /// `L: …; v = v + step; if v <= last then goto L`
  struct Loop {
    std::uint32_t begin = none; ///< the label
    std::uint32_t count = none; ///< the line that counts
    std::uint32_t test = none;
    std::uint32_t entry = none; ///< a jump to the test, before the label
    std::uint32_t variable = none;
    std::uint32_t last = none; ///< a term
    std::int32_t step = 0;
  };

  bool once() {
    named_ = tidy(code_);
    at_ = lines_of_labels(code_);
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      if (auto loop = counted_by(i); loop && only_left_at_end(*loop) && counts_alone(*loop) &&
                                     depth_with(*loop) <= spec::value_of(spec::Limit::ForDepth)) {
        write(*loop);
        return true;
      }
    return false;
  }

  std::optional<Loop> counted_by(std::uint32_t i) {
    const auto& test = code_.lines[i];
    if (test.kind != LineKind::If || test.guard || named_[test.label] != 1 ||
        at_[test.label] >= i || code_.conditions[test.condition].glue != Glue::None)
      return std::nullopt;
    Loop loop;
    loop.begin = at_[test.label];
    loop.test = i;
    loop.count = i - 1;
    const auto& above = code_.lines[i - 1];
    if (above.kind == LineKind::Label) {
      loop.count = i - 2;
      loop.entry = loop.begin - 1;
      if (named_[above.label] != 1 || loop.begin == 0 || loop.count <= loop.begin ||
          code_.lines[loop.entry].kind != LineKind::Goto ||
          code_.lines[loop.entry].label != above.label)
        return std::nullopt;
    }
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

  /// The last value that is counted where a loop goes on while a relation holds, or none.
  std::uint32_t last_of(Relation relation, const Loop& loop) {
    if (!reads_only(relation.left, loop.variable)) {
      std::swap(relation.left, relation.right);
      std::swap(relation.left_range, relation.right_range);
      relation.comparison = mirrored(relation.comparison);
    }
    if (!reads_only(relation.left, loop.variable) || code_.terms[relation.right].effects != 0)
      return none;
    if (code_.is_number(relation.right))
      relation.right_range = compiler::Range::only(code_.terms[relation.right].value);
    using Limits = std::numeric_limits<std::int32_t>;
    const auto& [counted, end] = std::pair{relation.left_range, relation.right_range};
    const bool up = loop.step > 0;
    // Counting to a number, it never comes past it.
    const bool arrives = relation.comparison == Comparison::NotEqual &&
                         (up ? counted.hi <= end.lo : counted.lo >= end.hi);
    if (relation.comparison == (up ? Comparison::LessEqual : Comparison::GreaterEqual))
      return relation.right;
    if (relation.comparison != (up ? Comparison::Less : Comparison::Greater) && !arrives)
      return none;
    if (up ? end.lo == Limits::min() : end.hi == Limits::max())
      return none;
    return code_.binary(up ? Operator::Subtract : Operator::Add, relation.right, code_.number(1));
  }

  bool is_within(const Loop& loop, std::uint32_t label) const {
    return at_[label] != none && loop.begin < at_[label] && at_[label] < loop.test;
  }

  /// Whether nothing leads out of a loop but its test, and nothing into it but its begin.
  bool only_left_at_end(const Loop& loop) {
    std::vector<std::uint32_t> inside(code_.labels, 0); // how often labels are named there
    bool good = true;
    for (auto i = loop.begin + 1; i < loop.test; ++i) {
      const auto& line = code_.lines[i];
      each_target(code_, line, [&](std::uint32_t label) {
        ++inside[label];
        good = good && is_within(loop, label);
      });
      good = good && line.kind != LineKind::Return;
    }
    for (auto i = loop.begin + 1; good && i < loop.count; ++i)
      if (code_.lines[i].kind == LineKind::Label)
        good = inside[code_.lines[i].label] == named_[code_.lines[i].label];
    return good;
  }

  /// Whether only line `count` sets the variable and the last value stays what it is.
  bool counts_alone(const Loop& loop) const {
    const auto flow = read_flow(code_);
    const LineFacts facts(code_, flow);
    for (auto i = loop.begin + 1; i < loop.test; ++i)
      if (const auto& line = code_.lines[i];
          facts.disturbs(line, loop.last) || (i != loop.count && facts.writes(line, loop.variable)))
        return false;
    return !facts.reads(loop.last, loop.variable);
  }

  /// How many loops of the robot are open at once at most, with this one.
  std::int64_t depth_with(const Loop& loop) const {
    std::vector<std::int64_t> above(code_.routines.size(), 0); // open where a routine is called
    std::int64_t deepest = 0;
    for (std::size_t round = 0; round < above.size(); ++round) {
      std::vector<std::int64_t> open = above;
      for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
        const auto& line = code_.lines[i];
        auto& here = open[line.routine];
        here += line.kind == LineKind::For || i == loop.begin ? 1 : 0;
        deepest = std::max(deepest, here);
        if (const auto callee = callee_of(line); callee != none)
          above[callee] = std::max(above[callee], here);
        here -= line.kind == LineKind::Next || i == loop.test ? 1 : 0;
      }
    }
    return deepest;
  }

  void write(const Loop& loop) {
    auto& lines = code_.lines;
    const auto test = lines[loop.test];
    auto first = lines[loop.count];
    first.kind = LineKind::For;
    first.term = code_.read(loop.variable);
    first.end = loop.last;
    first.step = loop.step;
    first.label = test.label;
    auto& next = lines[loop.test];
    next = lines[loop.count];
    next.kind = LineKind::Next;
    next.label = test.label;
    next.step = loop.step;
    next.term = none;
    lines[loop.count].kind = LineKind::Nothing;
    lines.insert(lines.begin() + loop.begin, first);
    if (loop.entry == none)
      return;
    auto& entry = lines[loop.entry];
    auto after = entry;
    after.kind = LineKind::Label;
    after.label = code_.labels++;
    code_.conditions.push_back(Condition{code_.conditions[test.condition]});
    auto& relation = code_.conditions.back().first;
    relation.comparison = opposite(relation.comparison);
    relation.left = code_.copy(relation.left);
    relation.right = code_.copy(relation.right);
    entry.kind = LineKind::If;
    entry.label = after.label;
    entry.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
    lines.insert(lines.begin() + loop.test + 2, after);
  }

  Code& code_;
  std::vector<std::uint32_t> named_; ///< of each label: how often
  std::vector<std::uint32_t> at_;    ///< of each label: its line
};

} // namespace

bool count_loops(Code& code) {
  return LoopCounter(code).run();
}

} // namespace orb::structured
