#include "structured/optimise/webs.h"

#include "structured/analyse/flow.h"

#include <utility>

namespace orb::structured {
namespace {

/// Splits variables into webs. A value is one assignment, or one entry into a block; values that
/// may reach the same place belong to the same web.
class Splitter {
public:
  explicit Splitter(Code& code)
      : code_(code), flow_(read_flow(code)), liveness_(read_liveness(code, flow_)) {}

  bool run() {
    find_candidates();
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      begins_.push_back(values_);
      each_member(liveness_.in[b], [&](std::uint32_t) { ++values_; });
    }
    walk([](std::uint32_t) {},
         [&](std::uint32_t value, std::uint32_t other) {
           const auto from = find(value);
           const auto to = find(other);
           parent_[from] = to;
         });
    find(values_all_);
    variable_of_.assign(parent_.size(), none);
    taken_.assign(code_.variables.size(), false);
    walk([&](std::uint32_t i) { rewrite(code_.lines[i]); }, [](std::uint32_t, std::uint32_t) {});
    return changed_;
  }

private:
  /// Finds variables whose values do not cross calls.
  void find_candidates() {
    candidate_.assign(code_.variables.size(), true);
    candidate_[index_variable] = false;
    for (std::uint32_t v = 0; v < candidate_.size(); ++v)
      if (code_.variables[v].kept)
        candidate_[v] = false;
    const auto passed = [&](std::uint32_t v) { candidate_[v] = false; };
    for (std::size_t r = 1; r < flow_.entries.size(); ++r)
      if (flow_.entries[r] != none) {
        each_member(liveness_.in[flow_.entries[r]], passed);
        each_member(liveness_.at_return[r], passed);
      }
  }

  /// Walks all blocks: `visit(line)` runs before the line's assignment takes effect, `meet(value,
  /// other)` where one value enters a block as the other.
  template <typename Visit, typename Meet>
  void walk(Visit visit, Meet meet) {
    auto fresh = values_;
    now_.assign(candidate_.size(), none);
    std::vector<std::uint32_t> set;
    std::vector<std::uint32_t> counters(code_.labels, none); // of each loop's label: a value
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      const auto& block = flow_.blocks[b];
      auto value = begins_[b];
      each_member(liveness_.in[b], [&](std::uint32_t v) { now_[v] = value++; });
      for (auto i = block.begin; i < block.end; ++i) {
        const auto& line = code_.lines[i];
        set.clear();
        if (line.kind != LineKind::Next) // it increments the value that it reads
          each_write(code_, line, [&](std::uint32_t v) { set.push_back(v); });
        const bool counts = line.kind == LineKind::For || line.kind == LineKind::Next;
        const auto counter = line.variable;
        next_ = fresh;
        visit(i);
        for (const auto v : set)
          now_[v] = fresh++;
        if (!counts)
          continue;
        // The robot needs the same variable in `for` and `next`, whatever is assigned in between.
        auto& tied = counters[line.label];
        if (tied != none && candidate_[counter])
          meet(now_[counter], tied);
        tied = now_[counter];
      }
      for (const auto next : flow_.successors_of(block)) {
        auto other = begins_[next];
        each_member(liveness_.in[next], [&](std::uint32_t v) {
          if (candidate_[v])
            meet(now_[v], other);
          ++other;
        });
      }
    }
    values_all_ = fresh;
  }

  std::uint32_t find(std::uint32_t value) {
    while (parent_.size() <= value)
      parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    while (parent_[value] != value)
      value = parent_[value] = parent_[parent_[value]];
    return value;
  }

  /// The variable for a value of `v`.
  std::uint32_t variable_of(std::uint32_t v, std::uint32_t value) {
    if (!candidate_[v] || value == none)
      return v;
    auto& variable = variable_of_[find(value)];
    if (variable == none) {
      variable = v;
      if (taken_[v]) {
        variable = code_.new_variable();
        code_.variables[variable].symbol = code_.variables[v].symbol;
        changed_ = true;
      }
      taken_[v] = true;
    }
    return variable;
  }

  std::uint32_t renamed(std::uint32_t root) {
    return with_variables(code_, root, [&](std::uint32_t term) {
      const auto before = code_.terms[term].left;
      const auto variable = variable_of(before, now_[before]);
      return variable == before ? term : code_.read(variable);
    });
  }

  void rewrite(CodeLine& line) {
    auto value = next_;
    each_root(code_, line, [&](std::uint32_t& root) {
      const auto v = line.variable;
      const bool last = line.kind == LineKind::For && &root == &line.end;
      const auto before = last ? std::exchange(now_[v], value) : none;
      root = renamed(root);
      if (last)
        now_[v] = before;
    });
    if (line.kind == LineKind::Next)
      line.variable = variable_of(line.variable, now_[line.variable]);
    if (line.kind == LineKind::Let || line.kind == LineKind::For)
      line.variable = variable_of(line.variable, value);
    if (line.kind == LineKind::Do)
      for (auto i = line.parts_begin; i < line.parts_end; ++i)
        if (auto& part = code_.parts[i]; part.kind == PartKind::Variable)
          part.value = variable_of(part.value, value++);
  }

  Code& code_;
  Flow flow_;
  Liveness liveness_;
  std::vector<bool> candidate_;            ///< of each variable
  std::vector<std::uint32_t> begins_;      ///< of each block: the first value that enters it
  std::uint32_t values_ = 0;               ///< values that enter blocks
  std::uint32_t values_all_ = 0;           ///< including those that lines assign
  std::vector<std::uint32_t> now_;         ///< of each variable: its current value
  std::uint32_t next_ = 0;                 ///< the value that the line assigns
  std::vector<std::uint32_t> parent_;      ///< union-find: of each value, another of its web
  std::vector<std::uint32_t> variable_of_; ///< of each root value
  std::vector<bool> taken_;                ///< of each variable: already used for one of its webs
  bool changed_ = false;
};

} // namespace

bool split_variables(Code& code) {
  return Splitter(code).run();
}

} // namespace orb::structured
