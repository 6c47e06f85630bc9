#include "structured/optimise/tails.h"

#include "structured/analyse/flow.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <map>

namespace orb::structured {
namespace {

/// True if one line can stand for both: a fault must be reported at its own statement.
bool may_join(const Code& code, const CodeLine& a, const CodeLine& b) {
  return a.origin == b.origin || !(a.guard || b.guard || may_fault(code, a) || may_fault(code, b));
}

bool same_part(const Code& code, const Part& a, const Part& b) {
  if (a.kind != b.kind || !(a.text == b.text))
    return false;
  if (a.kind == PartKind::Term || a.kind == PartKind::Character)
    return same(code, a.value, b.value);
  return a.value == b.value;
}

/// True if one of two lines that fall through can stand for both: they do the same.
bool does_same(const Code& code, const CodeLine& a, const CodeLine& b) {
  if (a.kind != b.kind || a.robot != b.robot || !falls_through(a) || !may_join(code, a, b))
    return false;
  if (a.kind == LineKind::Gosub)
    return a.label == b.label;
  if (a.kind == LineKind::Let || a.kind == LineKind::SetElement || a.kind == LineKind::SetSystem)
    return a.variable == b.variable && same(code, a.term, b.term);
  return (a.kind == LineKind::Print || a.kind == LineKind::Do) &&
         std::equal(code.parts.begin() + a.parts_begin, code.parts.begin() + a.parts_end,
                    code.parts.begin() + b.parts_begin, code.parts.begin() + b.parts_end,
                    [&](const Part& x, const Part& y) { return same_part(code, x, y); });
}

/// Joins the ranges of a line that now stands for another one, too.
void join_knowledge(Code& code, CodeLine& kept, const CodeLine& other) {
  kept.proven = kept.proven && other.proven;
  if (kept.kind == LineKind::If) {
    auto& relation = code.conditions[kept.condition].first;
    const auto& same = code.conditions[other.condition].first;
    relation.left_range = compiler::join(relation.left_range, same.left_range);
    relation.right_range = compiler::join(relation.right_range, same.right_range);
  } else if (kept.kind == LineKind::Print || kept.kind == LineKind::Do) {
    for (auto i = kept.parts_begin; i < kept.parts_end; ++i)
      code.parts[i].range = compiler::join(
          code.parts[i].range, code.parts[other.parts_begin + i - kept.parts_begin].range);
  }
}

class Merger {
public:
  explicit Merger(Code& code) : code_(code) {}

  bool run() {
    constexpr int most_rounds = 16;
    bool changed = false;
    for (int round = 0; round < most_rounds && once(); ++round)
      changed = true;
    return changed;
  }

private:
  /// Two paths that meet, each as the lines before its end.
  struct Tails {
    std::uint32_t kept_end = 0;
    std::uint32_t kept = 0;      ///< start of the common tail
    std::uint32_t other_end = 0; ///< a jump, `return` or `end`
    std::uint32_t other = 0;     ///< start of the common tail
    std::uint32_t lines() const { return kept_end - kept; }
  };
  bool once() {
    tidy(code_);
    taken_.assign(code_.lines.size() + 1, false);
    labels_.clear();
    loops_ = loops_of_lines(code_);
    const auto before = code_.lines.size();
    for (const auto& [key, ends] : find_ends())
      for (std::size_t b = 0; b < ends.size(); ++b)
        if (!falls_through(code_.lines[ends[b]]) && !taken_[ends[b]])
          merge(ends, ends[b]);
    if (labels_.empty())
      return false;
    std::sort(labels_.begin(), labels_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<CodeLine> lines;
    lines.reserve(before + labels_.size());
    auto next = labels_.begin();
    for (std::uint32_t i = 0; i < before; ++i) {
      for (; next != labels_.end() && next->first == i; ++next) {
        lines.push_back(code_.lines[i]);
        lines.back().kind = LineKind::Label;
        lines.back().label = next->second;
      }
      lines.push_back(code_.lines[i]);
    }
    code_.lines = std::move(lines);
    return true;
  }

  /// Of each place where paths meet: the ends of the paths.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> find_ends() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> ends;
    constexpr std::uint32_t returns = none;
    constexpr std::uint32_t stops = none - 1;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Goto)
        ends[{line.routine, line.label}].push_back(i);
      else if (line.kind == LineKind::Return)
        ends[{line.routine, returns}].push_back(i);
      else if (ends_program(line))
        ends[{line.routine, stops}].push_back(i);
      else if (line.kind == LineKind::Label && i > 0 && falls_through(code_.lines[i - 1]) &&
               code_.lines[i - 1].kind != LineKind::Label)
        ends[{line.routine, line.label}].push_back(i);
    }
    return ends;
  }

  /// Redirects the path that ends at `other` into the one with the longest common tail.
  void merge(const std::vector<std::uint32_t>& ends, std::uint32_t other) {
    Tails best;
    constexpr std::size_t most_ends = 24;
    for (std::size_t n = 0; n < std::min(ends.size(), most_ends); ++n)
      if (ends[n] != other && !taken_[ends[n]] && loops_[ends[n]] == loops_[other])
        if (const auto tails = compare(ends[n], other); tails.lines() > best.lines())
          best = tails;
    if (best.lines() == 0)
      return;
    for (auto i = best.kept; i < best.kept_end; ++i)
      join_knowledge(code_, code_.lines[i], code_.lines[best.other + i - best.kept]);
    for (auto i = best.kept; i <= best.kept_end; ++i)
      taken_[i] = true;
    for (auto i = best.other; i < best.other_end; ++i) {
      taken_[i] = true;
      code_.lines[i].kind = LineKind::Nothing;
    }
    taken_[best.other_end] = true;
    auto& jump = code_.lines[best.other_end];
    jump.kind = LineKind::Goto;
    jump.label = code_.labels++;
    jump.parts_begin = jump.parts_end = 0;
    labels_.push_back({best.kept, jump.label});
  }

  Tails compare(std::uint32_t kept_end, std::uint32_t other_end) const {
    auto kept = kept_end;
    auto other = other_end;
    while (kept > 0 && other > 0 && !taken_[kept - 1] && !taken_[other - 1] &&
           kept - 1 != other_end && other - 1 != kept_end &&
           matches(code_.lines[kept - 1], code_.lines[other - 1])) {
      --kept;
      --other;
    }
    return {kept_end, kept, other_end, other};
  }

  bool matches(const CodeLine& a, const CodeLine& b) const {
    if (a.routine != b.routine || a.kind != b.kind || !may_join(code_, a, b))
      return false;
    if (a.kind != LineKind::If)
      return does_same(code_, a, b);
    return a.label == b.label && same(code_.conditions[a.condition], code_.conditions[b.condition]);
  }

  bool same(const Condition& a, const Condition& b) const {
    return a.glue == Glue::None && b.glue == Glue::None &&
           a.first.comparison == b.first.comparison &&
           structured::same(code_, a.first.left, b.first.left) &&
           structured::same(code_, a.first.right, b.first.right);
  }

  Code& code_;
  std::vector<std::uint32_t> loops_; ///< of each line: its loop, which it must not leave
  std::vector<bool> taken_;          ///< of each line: already part of a tail
  std::vector<std::pair<std::uint32_t, std::uint32_t>> labels_; ///< lines and labels before them
};

} // namespace

bool merge_tails(Code& code) {
  return Merger(code).run();
}

} // namespace orb::structured
