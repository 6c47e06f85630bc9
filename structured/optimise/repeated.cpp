#include "structured/optimise/repeated.h"

#include "structured/analyse/ranges.h"

#include <algorithm>

namespace orb::structured {
namespace {

using compiler::Range;

/// Finds calls and assignments whose effect is already in place. Each sub, each kind of call to a
/// sub that changes its inputs, and each assignment has a number, its deed; subs come first. Large
/// because it follows calls, assignments and array elements at once: each of them can invalidate
/// the others.
class RepeatFinder {
public:
  explicit RepeatFinder(Code& code)
      : code_(code), ranges_(code), flow_(ranges_.flow()), liveness_(read_liveness(code, flow_)),
        repeatable_(code.routines.size(), true), changed_(code.routines.size()),
        deed_of_(code.lines.size(), none), stored_(code.routines.size()),
        stores_(code.lines.size()) {}

  /// Removes redundant lines; returns true if there were any.
  bool run() {
    find_repeatable();
    number_deeds();
    if (!ranges_.follow())
      return false;
    find_elements();
    follow();
    return rewrite();
  }

private:
  /// The elements that a line reads or sets: a range of the index, or nothing.
  struct Elements {
    std::optional<Range> index;

    void add(const Elements& other) {
      if (other.index)
        index = index ? compiler::join(*index, *other.index) : *other.index;
    }
    bool meets(const Elements& other) const {
      return index && other.index && !index->misses(other.index->lo, other.index->hi);
    }
  };

  /// True if a line gives the same result for the same inputs and has no visible effect.
  bool repeats(const CodeLine& line) const {
    constexpr std::uint8_t moving = effect::clears | effect::senses;
    const auto callee = callee_of(line);
    return line.kind != LineKind::SetElement && line.kind != LineKind::SetSystem &&
           line.kind != LineKind::Print && line.kind != LineKind::Do &&
           (effects_of(code_, line) & moving) == 0 && (callee == none || repeatable_[callee]);
  }

  /// True if repeating an assignment would set the same value.
  bool sets_again(const CodeLine& line) const {
    if (line.kind != LineKind::Let || line.guard || !repeats(line))
      return false;
    bool itself = false;
    each_read(code_, line.term, [&](std::uint32_t v) { itself = itself || v == line.variable; });
    return !itself;
  }

  /// Finds routines that only compute, and the inputs that each of them changes.
  void find_repeatable() {
    repeatable_[0] = false;
    for (std::size_t r = 1; r < repeatable_.size(); ++r) {
      const auto entry = flow_.entries[r];
      repeatable_[r] = entry != none;
      if (entry != none)
        each_member(flow_.written[r], [&](std::uint32_t v) {
          if (contains(liveness_.in[entry], v))
            changed_[r].push_back(v);
        });
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& line : code_.lines)
        if (repeatable_[line.routine] && !repeats(line)) {
          repeatable_[line.routine] = false;
          changed = true;
        }
    }
  }

  void number_deeds() {
    deeds_ = static_cast<std::uint32_t>(code_.routines.size());
    number_calls();
    std::vector<std::vector<std::uint32_t>> sets(code_.variables.size()); // lines
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      if (deed_of_[i] != none || !sets_again(line))
        continue;
      auto& others = sets[line.variable];
      const auto same_one = std::find_if(others.begin(), others.end(), [&](std::uint32_t other) {
        return same(code_, code_.lines[other].term, line.term);
      });
      if (same_one != others.end()) {
        deed_of_[i] = deed_of_[*same_one];
        continue;
      }
      deed_of_[i] = deeds_++;
      others.push_back(i);
    }
    read_.assign(deeds_, {});
    spoilt_by_ = VariableSets(code_.variables.size(), deeds_);
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      const auto deed = deed_of_[i];
      if (deed == none)
        continue;
      each_root(code_, line, [&](std::uint32_t root) {
        each_read(code_, root, [&](std::uint32_t v) { insert(spoilt_by_[v], deed); });
      });
      if (const auto callee = callee_of(line); callee != none)
        find_spoilers(callee, deed);
      else if (deed >= first_set_)
        insert(spoilt_by_[line.variable], deed);
    }
  }

  /// Finds the variables that invalidate a call: its inputs and its results, except inputs that it
  /// overwrites.
  void find_spoilers(std::uint32_t callee, std::uint32_t deed) {
    each_member(flow_.touched[callee], [&](std::uint32_t v) {
      const bool is_set = contains(flow_.written[callee], v);
      if (is_set ? contains(liveness_.at_return[callee], v)
                 : contains(liveness_.in[flow_.entries[callee]], v))
        insert(spoilt_by_[v], deed);
    });
  }

  void number_calls() {
    std::vector<std::vector<std::uint32_t>> calls(code_.routines.size()); // distinct calls
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      const auto callee = callee_of(code_.lines[i]);
      if (callee == none || !repeatable_[callee])
        continue;
      if (changed_[callee].empty()) {
        deed_of_[i] = callee;
        continue;
      }
      const auto giving = lines_that_give(i);
      if (giving.empty())
        continue;
      auto& others = calls[callee];
      const auto same_one = std::find_if(others.begin(), others.end(), [&](std::uint32_t other) {
        return gets_the_same(other, giving);
      });
      const bool is_new = same_one == others.end();
      deed_of_[i] = is_new ? deeds_++ : deed_of_[*same_one];
      for (const auto n : giving)
        deed_of_[n] = deed_of_[i];
      if (is_new)
        others.push_back(i);
    }
    first_set_ = deeds_;
  }

  /// The lines above a call that set all inputs that it changes, from values that neither they nor
  /// the call change.
  std::vector<std::uint32_t> lines_that_give(std::uint32_t call) const {
    const auto callee = callee_of(code_.lines[call]);
    const auto written = flow_.written[callee];
    std::vector<std::uint64_t> set(written.begin(), written.end());
    auto missing = changed_[callee];
    std::vector<std::uint32_t> giving;
    for (auto i = call; !missing.empty() && i-- > 0;) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Nothing)
        continue;
      const bool again = std::any_of(giving.begin(), giving.end(), [&](std::uint32_t other) {
        return code_.lines[other].variable == line.variable;
      });
      if (line.kind != LineKind::Let || line.guard || !is_still(line.term) || again ||
          !contains(liveness_.in[flow_.entries[callee]], line.variable))
        return {};
      std::erase(missing, line.variable);
      insert(set, line.variable);
      giving.push_back(i);
    }
    bool stays = missing.empty();
    for (const auto i : giving)
      each_read(code_, code_.lines[i].term,
                [&](std::uint32_t v) { stays = stays && !contains(set, v); });
    return stays ? giving : std::vector<std::uint32_t>{};
  }

  /// True if a term depends only on variables.
  bool is_still(std::uint32_t term) const {
    return (code_.terms[term].effects & (effect::clears | effect::senses | effect::elements)) == 0;
  }

  /// True if the lines above a numbered call assign the same values as `giving`.
  bool gets_the_same(std::uint32_t call, const std::vector<std::uint32_t>& giving) const {
    auto n = call;
    return std::all_of(giving.begin(), giving.end(), [&](std::uint32_t i) {
      do
        if (n == 0)
          return false;
      while (code_.lines[--n].kind == LineKind::Nothing);
      return deed_of_[n] == deed_of_[call] && code_.lines[n].variable == code_.lines[i].variable &&
             same(code_, code_.lines[n].term, code_.lines[i].term);
    });
  }

  void find_elements() {
    ranges_.each_state([&](std::uint32_t i, const VariableRanges& state) {
      const auto& line = code_.lines[i];
      const Elements here{state[index_variable]};
      if (sets_element(code_, line))
        stores_[i] = here;
      stored_[line.routine].add(stores_[i]);
      if ((effects_of(code_, line) & effect::elements) == 0)
        return;
      read_[line.routine].add(here);
      if (deed_of_[i] != none)
        read_[deed_of_[i]].add(here);
    });
    for (std::size_t round = 0; round < code_.routines.size(); ++round)
      for (const auto& line : code_.lines)
        if (const auto callee = callee_of(line); callee != none) {
          read_[line.routine].add(read_[callee]);
          stored_[line.routine].add(stored_[callee]);
        }
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      if (const auto callee = callee_of(code_.lines[i]); callee != none && deed_of_[i] != none)
        read_[deed_of_[i]].add(read_[callee]);
    for (std::uint32_t deed = 0; deed < deeds_; ++deed)
      if (read_[deed].index)
        readers_.push_back(deed);
  }

  // ---- invalidation

  void spoil(std::span<std::uint64_t> stale, const Elements& set) const {
    if (!set.index)
      return;
    for (const auto deed : readers_)
      if (set.meets(read_[deed]))
        insert(stale, deed);
  }

  /// Executes a line: `stale` is the set of deeds whose effect is no longer in place.
  void step(std::uint32_t i, std::span<std::uint64_t> stale) const {
    const auto& line = code_.lines[i];
    const auto deed = deed_of_[i];
    const auto callee = callee_of(line);
    // An index set to an invalid value by its check stops the program before anything else.
    if ((deed != none && !contains(stale, deed)) || (line.guard && line.kind == LineKind::Let))
      return;
    each_write(code_, line, [&](std::uint32_t v) { unite(stale, spoilt_by_[v]); });
    spoil(stale, stores_[i]);
    if (callee != none) {
      each_member(flow_.written[callee], [&](std::uint32_t v) { unite(stale, spoilt_by_[v]); });
      spoil(stale, stored_[callee]);
      for (std::size_t w = 0; w < stale.size(); ++w)
        stale[w] &= returned_[callee][w];
    }
    if (deed != none && (callee != none || deed >= first_set_))
      remove(stale, deed);
  }

  void follow() {
    begins_ = VariableSets(flow_.blocks.size(), deeds_);
    returned_ = VariableSets(code_.routines.size(), deeds_);
    entered_.assign(flow_.blocks.size(), false);
    comes_back_.assign(code_.routines.size(), false);
    for (std::uint32_t deed = 0; deed < deeds_; ++deed)
      insert(begins_[0], deed);
    if (!entered_.empty())
      entered_[0] = true;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
        changed = follow(b) || changed;
    }
  }

  /// Enters a block with the stale deeds; returns true if that is new.
  bool enter(std::uint32_t b) {
    const bool first = !entered_[b];
    entered_[b] = true;
    return unite(begins_[b], stale_) || first;
  }

  bool follow(std::uint32_t b) {
    const auto& block = flow_.blocks[b];
    bool changed = false;
    const bool ends = walk(b, [&](std::uint32_t i) {
      if (const auto callee = callee_of(code_.lines[i]);
          callee != none && flow_.entries[callee] != none)
        changed = enter(flow_.entries[callee]) || changed;
    });
    if (!ends)
      return changed;
    const auto& last = code_.lines[block.end - 1];
    for (const auto next : flow_.successors_of(block))
      changed = enter(next) || changed;
    if (last.kind == LineKind::Return) {
      const bool first = !comes_back_[last.routine];
      comes_back_[last.routine] = true;
      changed = unite(returned_[last.routine], stale_) || first || changed;
    }
    return changed;
  }

  /// Calls `visit` with each line of a reachable block; `stale_` holds the stale deeds before it.
  /// Returns false if the end of the block is unreachable.
  template <typename Visit>
  bool walk(std::uint32_t b, Visit visit) {
    if (!entered_[b])
      return false;
    const auto begin = begins_[b];
    stale_.assign(begin.begin(), begin.end());
    for (auto i = flow_.blocks[b].begin; i < flow_.blocks[b].end; ++i) {
      visit(i);
      step(i, stale_);
      if (const auto callee = callee_of(code_.lines[i]); callee != none && !comes_back_[callee])
        return false;
    }
    return true;
  }

  /// Removes the redundant lines.
  bool rewrite() {
    std::vector<std::uint32_t> dropped; // lines
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
      if (ranges_.reaches(b))
        walk(b, [&](std::uint32_t i) {
          if (deed_of_[i] != none && !contains(stale_, deed_of_[i]))
            dropped.push_back(i);
        });
    for (const auto i : dropped)
      code_.lines[i].kind = LineKind::Nothing;
    return !dropped.empty();
  }

  Code& code_;
  Ranges ranges_;
  const Flow& flow_;
  Liveness liveness_;
  std::vector<bool> repeatable_;                    ///< of each routine
  std::vector<std::vector<std::uint32_t>> changed_; ///< of each: the inputs that it changes
  std::vector<std::uint32_t> deed_of_;              ///< of each line: its deed, or none
  std::uint32_t deeds_ = 0;
  std::uint32_t first_set_ = 0;        ///< the first deed that is an assignment
  std::vector<Elements> read_;         ///< of each deed; for routines including callees
  std::vector<std::uint32_t> readers_; ///< deeds that read elements
  std::vector<Elements> stored_;       ///< of each routine, including callees
  std::vector<Elements> stores_;       ///< of each line alone
  VariableSets spoilt_by_;             ///< of each variable: deeds that an assignment to it makes
                                       ///< stale
  VariableSets begins_;                ///< of each block: stale deeds at its start
  VariableSets returned_;              ///< of each routine: stale deeds at its return
  std::vector<bool> entered_;          ///< of each block: it is reachable
  std::vector<bool> comes_back_;       ///< of each routine
  std::vector<std::uint64_t> stale_;
};

} // namespace

bool drop_repeated(Code& code) {
  return RepeatFinder(code).run();
}

} // namespace orb::structured
