#include "structured/optimise/arms.h"

#include "structured/analyse/ranges.h"
#include "structured/analyse/sizes.h"
#include "structured/optimise/jumps.h"

#include <limits>
#include <utility>

namespace orb::structured {
namespace {

using compiler::Range;
using spec::Operator;

class Computer {
public:
  explicit Computer(Code& code) : code_(code) {}

  bool run() {
    named_ = tidy(code_);
    bool any = false;
    for (auto i = static_cast<std::uint32_t>(code_.lines.size()); i-- > 0;)
      if (const auto arms = arms_at(code_, named_, i); arms && arms->is_short())
        any = compute(i, *arms) || any;
    return any;
  }

private:
  /// The term that is `taken` if a relation holds and `passed` otherwise; none if there is none.
  std::uint32_t between(const Relation& relation, Sum taken, Sum passed) {
    const auto [lo, hi] = std::pair{relation.left_range.lo, relation.left_range.hi};
    if (std::int64_t{lo} + 1 != hi || !code_.is_number(relation.right) ||
        (taken.base == none) != (passed.base == none) ||
        (taken.base != none &&
         (code_.terms[taken.base].effects != 0 || !same(code_, taken.base, passed.base))))
      return none;
    const auto right = Range::only(code_.terms[relation.right].value);
    const bool at_lo = where(relation.comparison, Range::only(lo), right).has_value();
    if (at_lo == where(relation.comparison, Range::only(hi), right).has_value())
      return none;
    const auto first = at_lo ? taken.number : passed.number;
    const auto by = (at_lo ? passed.number : taken.number) - first;
    const auto fixed = first - by * lo;
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    if (by == 0 || std::max(std::abs(by), std::abs(fixed)) > most)
      return none;
    const auto product = code_.binary(Operator::Multiply, relation.left,
                                      code_.number(static_cast<std::int32_t>(std::abs(by))));
    const auto number = code_.number(static_cast<std::int32_t>(fixed));
    if (taken.base == none && by > 0)
      return checked(code_.binary(Operator::Add, product, number));
    const auto start =
        taken.base == none ? number : code_.binary(Operator::Add, taken.base, number);
    return checked(code_.binary(by > 0 ? Operator::Add : Operator::Subtract, start, product));
  }

  std::uint32_t checked(std::uint32_t term) const {
    return code_.terms[term].levels > spec::value_of(spec::Limit::ExpressionLevels) ? none : term;
  }

  /// Replaces a test and its arms by one line if the arms differ only in numbers that can be
  /// computed from the tested value.
  bool compute(std::uint32_t i, const Arms& arms) {
    const auto& condition = code_.conditions[code_.lines[i].condition];
    auto line = copy_line(code_, code_.lines[arms.passed]);
    if (condition.glue != Glue::None)
      return false;
    const auto relation = condition.first;
    const auto effects = code_.terms[relation.left].effects;
    const bool sets = line.kind == LineKind::Let;
    if ((effects & (sets ? effect::faults : 0xFF)) != 0)
      return false;
    if (!arms.has_both()) { // `if c then v = v + 1`
      const Sum passed = sets ? sum_of(code_, line.term) : Sum{};
      const auto itself = Sum{passed.base, 0};
      if (passed.base == none || code_.terms[passed.base].kind != TermKind::Variable ||
          code_.terms[passed.base].left != line.variable)
        return false;
      line.term = between(relation, itself, passed);
      return line.term != none && replace(i, arms, line);
    }
    const auto& other = code_.lines[arms.taken];
    if (line.kind != other.kind || line.robot != other.robot || line.variable != other.variable ||
        line.parts_end - line.parts_begin != other.parts_end - other.parts_begin)
      return false;
    bool good = true;
    bool differ = false; // otherwise the test would not matter
    const auto compute_root = [&](std::uint32_t& root, std::uint32_t that) {
      if (!good || same(code_, root, that))
        return;
      differ = true;
      const auto passed = sum_of(code_, root);
      const auto taken = sum_of(code_, that);
      root = between(relation, taken, passed);
      good = root != none;
    };
    if (line.term != none)
      compute_root(line.term, other.term);
    for (auto n = line.parts_begin; good && n < line.parts_end; ++n) {
      auto& part = code_.parts[n];
      const auto& there = code_.parts[other.parts_begin + n - line.parts_begin];
      const bool computed = part.kind == PartKind::Term || part.kind == PartKind::Character;
      good = part.kind == there.kind && part.text == there.text &&
             (computed || part.value == there.value);
      part.range = compiler::join(part.range, there.range);
      if (auto value = part.value; good && computed) {
        compute_root(value, there.value); // this may move the parts
        code_.parts[n].value = value;
      }
    }
    line.proven = line.proven && other.proven;
    return good && differ &&
           bytes_of(code_, line) < bytes_of(code_, code_.lines[i]) + bytes_of(code_, other) &&
           replace(i, arms, line);
  }

  bool replace(std::uint32_t i, const Arms& arms, const CodeLine& line) {
    for (auto n = i; n < arms.taken_end; ++n)
      code_.lines[n].kind = LineKind::Nothing;
    code_.lines[i] = line;
    return true;
  }

  Code& code_;
  std::vector<std::uint32_t> named_; ///< of each label: its references
};

} // namespace

std::optional<Arms> arms_at(const Code& code, std::span<const std::uint32_t> named,
                            std::uint32_t i) {
  const auto& lines = code.lines;
  const auto size = static_cast<std::uint32_t>(lines.size());
  const auto arm_end = [&](std::uint32_t n) {
    while (n < size && fits_arm(lines[n]) && !lines[n].guard)
      ++n;
    return n;
  };
  const auto& test = lines[i];
  if (test.kind != LineKind::If || test.guard)
    return std::nullopt;
  Arms arms;
  arms.passed = i + 1;
  arms.passed_end = arm_end(arms.passed);
  arms.taken = arms.taken_end = arms.passed_end;
  if (arms.passed == arms.passed_end)
    return std::nullopt;
  const auto is_at = [&](LineKind kind, std::uint32_t n, std::uint32_t label) {
    return n < size && lines[n].kind == kind && lines[n].label == label;
  };
  for (const auto kind : {LineKind::Label, LineKind::Goto})
    if (is_at(kind, arms.taken, test.label))
      return arms;
  if (arms.taken == size || !is_at(LineKind::Label, arms.taken + 1, test.label) ||
      named[test.label] != 1)
    return std::nullopt;
  const auto& leave = lines[arms.taken];
  arms.taken += 2;
  arms.taken_end = arm_end(arms.taken);
  const bool meets = (leave.kind == LineKind::Goto || leave.kind == LineKind::Return) &&
                     (is_at(leave.kind, arms.taken_end, leave.label) ||
                      is_at(LineKind::Label, arms.taken_end, leave.label));
  return meets && arms.has_both() ? std::optional(arms) : std::nullopt;
}

bool compute_arms(Code& code) {
  return Computer(code).run();
}

} // namespace orb::structured
