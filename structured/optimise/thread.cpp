#include "structured/optimise/thread.h"

#include "structured/optimise/arms.h"
#include "structured/optimise/jumps.h"

#include <algorithm>

namespace orb::structured {
namespace {

constexpr int longest_way = 12; ///< steps that a path is followed

class Threader {
public:
  Threader(Code& code, Ranges& ranges, std::vector<AddedLine>& added)
      : code_(code), ranges_(ranges), flow_(ranges.flow()),
        liveness_(read_liveness(code, ranges.flow())), named_(names_of_labels(code)),
        added_(added) {}

  bool run() {
    block_at_.assign(code_.lines.size() + 1, none);
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
      block_at_[flow_.blocks[b].begin] = b;
    undecided_.assign(flow_.blocks.size(), 0);
    for (const auto entry : flow_.entries)
      if (entry != none)
        ++undecided_[entry];
    ranges_.each_state([](std::uint32_t, const VariableRanges&) {},
                       [&](std::uint32_t b, VariableRanges& state) { leave(b, state); });
    for (const auto& shortcut : shortcuts_)
      take(shortcut);
    for (const auto& [block, label] : labels_) {
      auto line = code_.lines[flow_.blocks[block].begin];
      line.kind = LineKind::Label;
      line.label = label;
      added_.push_back({flow_.blocks[block].begin, line});
    }
    return changed_;
  }

private:
  /// An edge between two blocks that is known to continue to a third.
  struct Shortcut {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t end;
    std::uint32_t* label; ///< the label of the edge; nullptr: `from` falls through into `to`
  };

  std::uint32_t block_of(std::uint32_t label) const {
    return label < flow_.block_of_label.size() ? flow_.block_of_label[label] : none;
  }

  /// True if a block only assigns variables before it jumps or tests.
  bool leads_on(std::uint32_t b) const {
    for (auto i = flow_.blocks[b].begin; i < flow_.blocks[b].end; ++i) {
      const auto kind = code_.lines[i].kind;
      if (kind == LineKind::Goto || kind == LineKind::If || kind == LineKind::On)
        return true;
      if (kind != LineKind::Label && kind != LineKind::Nothing && kind != LineKind::Let)
        return false;
    }
    return false;
  }

  void leave(std::uint32_t b, VariableRanges& state) {
    auto& line = code_.lines[flow_.blocks[b].end - 1];
    const auto next = b + 1 < flow_.blocks.size() ? b + 1 : none;
    if (line.kind == LineKind::If) {
      if (block_of(line.label) == none)
        return look(b, next, nullptr, nullptr); // it continues through the added lines
      const auto& relation = code_.conditions[line.condition].first;
      auto copy = leads_on(block_of(line.label)) ? state : VariableRanges{};
      if (copy.empty() || ranges_.narrow(relation, relation.comparison, copy))
        look(b, block_of(line.label), &line.label, copy.empty() ? nullptr : &copy);
      if (ranges_.narrow(relation, opposite(relation.comparison), state))
        look(b, next, nullptr, &state);
    } else if (line.kind == LineKind::Goto) {
      look(b, block_of(line.label), &line.label, &state);
    } else if (line.kind == LineKind::Next) {
      look(b, block_of(line.label), nullptr, nullptr);
      look(b, next, nullptr, nullptr);
    } else if (!falls_through(line)) {
      each_target(code_, line,
                  [&](std::uint32_t label) { look(b, block_of(label), nullptr, nullptr); });
    } else {
      look(b, next, nullptr, &state);
    }
  }

  void look(std::uint32_t from, std::uint32_t to, std::uint32_t* label, VariableRanges* state) {
    if (to == none)
      return;
    below_ = label != nullptr ? from + 1 : none;
    const auto end = state == nullptr || !leads_on(to) ? to : follow(to, *state);
    if (end == to)
      ++undecided_[to];
    else
      shortcuts_.push_back({from, to, end, label});
  }

  /// Follows an edge through lines that it can skip; returns the block where it ends.
  std::uint32_t follow(std::uint32_t block, VariableRanges& state) {
    std::vector<std::uint32_t> set;
    steps_ = 0;
    return follow(flow_.blocks[block].begin, state, set);
  }

  std::uint32_t follow(std::uint32_t i, VariableRanges& state, std::vector<std::uint32_t>& set) {
    std::uint32_t best = none;
    for (; i < code_.lines.size() && ++steps_ < longest_way; ++i) {
      if (const auto b = block_at_[i];
          b != none && std::none_of(set.begin(), set.end(),
                                    [&](std::uint32_t v) { return contains(liveness_.in[b], v); }))
        best = b;
      if (best != none && best == below_)
        return best; // no jump at all is best
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Label || line.kind == LineKind::Nothing)
        continue;
      if (line.kind == LineKind::Goto && block_of(line.label) != none) {
        i = flow_.blocks[block_of(line.label)].begin - 1;
        continue;
      }
      if (line.kind == LineKind::Let && is_pure(line.term) && line.variable != index_variable) {
        state[line.variable] = ranges_.range_of(line.term, state);
        set.push_back(line.variable);
        continue;
      }
      if (line.kind == LineKind::On) {
        const auto chosen = chosen_of(line, state);
        if (chosen == none)
          return best;
        i = flow_.blocks[chosen].begin - 1;
        continue;
      }
      if (line.kind != LineKind::If || block_of(line.label) == none)
        return best;
      const auto& relation = code_.conditions[line.condition].first;
      if (!is_pure(relation.left) || !is_pure(relation.right))
        return best;
      auto taken = state;
      const bool can_hold = ranges_.narrow(relation, relation.comparison, taken);
      const bool can_fail = ranges_.narrow(relation, opposite(relation.comparison), state);
      const auto target = flow_.blocks[block_of(line.label)].begin;
      if (can_hold && can_fail) {
        auto other = set;
        const auto there = follow(target, taken, other);
        const auto here = follow(i + 1, state, set);
        return here == there && here != none ? here : best;
      }
      if (can_hold) {
        state = std::move(taken);
        i = target - 1;
      }
    }
    return best;
  }

  /// The block that an `on` jumps to, or none.
  std::uint32_t chosen_of(const CodeLine& line, const VariableRanges& state) const {
    const auto label = is_pure(line.term) ? chosen_label(code_, ranges_, line, state) : none;
    return label == none ? none : block_of(label);
  }

  bool is_pure(std::uint32_t term) const {
    return (code_.terms[term].effects & (effect::faults | effect::clears)) == 0;
  }

  void take(const Shortcut& shortcut) {
    // Keep a test on one line with its arm, unless the test that it leads to disappears.
    if (shortcut.label != nullptr && undecided_[shortcut.to] > 0 &&
        is_one_line(code_, named_, flow_.blocks[shortcut.from].end - 1))
      return;
    if (shortcut.label != nullptr) {
      *shortcut.label = label_of(shortcut.end);
      changed_ = true;
      return;
    }
    auto& last = code_.lines[flow_.blocks[shortcut.from].end - 1];
    const bool setting = last.kind == LineKind::Let && is_pure(last.term) &&
                         last.variable != index_variable &&
                         !contains(liveness_.in[shortcut.end], last.variable);
    const auto& first = code_.lines[flow_.blocks[shortcut.to].begin];
    const bool jumps = first.kind == LineKind::Goto && block_of(first.label) == shortcut.end;
    if (!setting && (undecided_[shortcut.to] > 0 || jumps))
      return;
    CodeLine jump;
    jump.kind = LineKind::Goto;
    jump.label = label_of(shortcut.end);
    jump.origin = last.origin;
    jump.routine = last.routine;
    if (setting)
      last = jump;
    else
      added_.push_back({flow_.blocks[shortcut.to].begin, jump});
    changed_ = true;
  }

  std::uint32_t label_of(std::uint32_t block) {
    for (auto i = flow_.blocks[block].begin; i < flow_.blocks[block].end; ++i)
      if (code_.lines[i].kind == LineKind::Label)
        return code_.lines[i].label;
      else if (code_.lines[i].kind != LineKind::Nothing)
        break;
    for (const auto& [other, label] : labels_)
      if (other == block)
        return label;
    labels_.push_back({block, code_.labels++});
    return labels_.back().second;
  }

  Code& code_;
  Ranges& ranges_;
  const Flow& flow_;
  Liveness liveness_;
  std::vector<std::uint32_t> named_; ///< of each label: its references
  std::vector<AddedLine>& added_;
  std::vector<std::uint32_t> block_at_;  ///< of each line: the block that begins there, or none
  std::vector<std::uint32_t> undecided_; ///< of each block: incoming edges with an unknown outcome
  std::vector<Shortcut> shortcuts_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> labels_; ///< labels to add to blocks
  std::uint32_t below_ = none; ///< the block below the current jump
  int steps_ = 0;
  bool changed_ = false;
};

} // namespace

bool thread_tests(Code& code, Ranges& ranges, std::vector<AddedLine>& added) {
  return Threader(code, ranges, added).run();
}

} // namespace orb::structured
