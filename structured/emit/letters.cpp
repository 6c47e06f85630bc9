#include "structured/emit/letters.h"

#include "spec/limits.h"
#include "structured/optimise/flow.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace orb::structured {
namespace {

constexpr std::uint8_t index_letter = 24; // Y
static_assert(index_letter + 1 == spec::value_of(spec::Limit::DirectVariables));

/// Which variables must not share a letter.
class Interference {
public:
  explicit Interference(const Code& code)
      : code_(code), flow_(read_flow(code)), liveness_(read_liveness(code, flow_)),
        edges(code.variables.size(), code.variables.size()), used(code.variables.size(), false) {
    for (std::uint32_t v = 0; v < code.variables.size(); ++v)
      used[v] = code.variables[v].kept;
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
      read_block(b);
  }

private:
  const Code& code_;
  Flow flow_;
  Liveness liveness_;

public:
  VariableSets edges;
  std::vector<bool> used;
  std::uint32_t crowded_line = none;
  std::vector<std::uint64_t> crowd;
  std::size_t pressure = 0;

private:
  std::vector<std::uint64_t> live_;

  void read_block(std::uint32_t b) {
    const auto out = liveness_.out[b];
    auto& live = live_;
    live.assign(out.begin(), out.end());
    for (auto i = flow_.blocks[b].end; i-- > flow_.blocks[b].begin;) {
      const auto& line = code_.lines[i];
      each_line_read(code_, line, [&](std::uint32_t v) { used[v] = true; });
      each_write(code_, line, [&](std::uint32_t v) {
        used[v] = true;
        add_edges(line, v, live);
        add_edges(line, v, liveness_.across[line.routine]);
      });
      // The end of a loop is computed when its variable has been set.
      if (line.kind == LineKind::For)
        each_read(code_, line.end, [&](std::uint32_t v) { add_edge(line.variable, v); });
      step_back(code_, flow_, liveness_, line, live);
      measure(i, live);
    }
  }

  void measure(std::uint32_t line, const std::vector<std::uint64_t>& live) {
    const auto across = liveness_.across[code_.lines[line].routine];
    std::size_t count = 0;
    for (std::size_t w = 0; w < live.size(); ++w)
      count += static_cast<std::size_t>(std::popcount(live[w] | across[w]));
    if (count <= pressure)
      return;
    pressure = count;
    crowded_line = line;
    crowd = live;
    unite(crowd, across);
  }

  void add_edges(const CodeLine& line, std::uint32_t variable,
                 std::span<const std::uint64_t> live) {
    const auto& term = line.kind == LineKind::Let ? code_.terms[line.term] : Term{};
    const auto source = term.kind == TermKind::Variable ? term.left : none;
    each_member(live, [&](std::uint32_t other) {
      if (other != source)
        add_edge(variable, other);
    });
  }

  void add_edge(std::uint32_t a, std::uint32_t b) {
    if (a == b)
      return;
    insert(edges[a], b);
    insert(edges[b], a);
  }
};

/// Classes of variables that share a letter because they are copies of each other.
class Classes {
public:
  explicit Classes(VariableSets edges, std::size_t count)
      : edges_(std::move(edges)), members_(count, count), parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (std::uint32_t v = 0; v < count; ++v)
      insert(members_[v], v);
  }

  std::uint32_t find(std::uint32_t v) const {
    while (parent_[v] != v)
      v = parent_[v];
    return v;
  }

  bool meet(std::uint32_t a, std::uint32_t b) const {
    const auto edges = edges_[a];
    const auto members = members_[b];
    for (std::size_t w = 0; w < edges.size(); ++w)
      if ((edges[w] & members[w]) != 0)
        return true;
    return false;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b || meet(a, b))
      return;
    if (b == index_variable)
      std::swap(a, b);
    parent_[b] = a;
    unite(edges_[a], edges_[b]);
    unite(members_[a], members_[b]);
  }

  std::span<const std::uint64_t> members(std::uint32_t root) const { return members_[root]; }
  std::span<const std::uint64_t> edges(std::uint32_t root) const { return edges_[root]; }

private:
  VariableSets edges_;
  VariableSets members_;
  std::vector<std::uint32_t> parent_;
};

/// Colours the classes; false where the letters do not suffice.
class Colouring {
public:
  Colouring(const Classes& classes, const std::vector<bool>& used,
            const std::vector<std::uint8_t>& wishes, std::uint32_t letters, bool index_used)
      : classes_(classes), wishes_(wishes), letters_(letters) {
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      bool any = false;
      if (classes.find(v) == v)
        each_member(classes.members(v), [&](std::uint32_t member) { any = any || used[member]; });
      if (any && v != index_variable)
        roots_.push_back(v);
    }
    find_neighbours(used.size());
    letter_.assign(used.size(), no_letter);
    if (index_used)
      letter_[index_variable] = index_letter;
  }

  bool run() {
    for (const auto root : order())
      if (!colour(root))
        return false;
    return true;
  }

  std::uint8_t letter(std::uint32_t v) const { return letter_[classes_.find(v)]; }

private:
  void find_neighbours(std::size_t variables) {
    neighbours_.resize(variables);
    std::vector<std::uint32_t> last(variables, none); // that a class was found to be next to
    for (const auto root : roots_)
      each_member(classes_.edges(root), [&](std::uint32_t v) {
        const auto other = classes_.find(v);
        if (other == root || other == index_variable || last[other] == root)
          return;
        last[other] = root;
        neighbours_[root].push_back(other);
      });
  }

  /// Those with few neighbours last: they find a letter whatever the others have.
  std::vector<std::uint32_t> order() const {
    constexpr auto gone = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> degree(neighbours_.size());
    for (const auto root : roots_)
      degree[root] = neighbours_[root].size();
    std::vector<std::uint32_t> ordered;
    for (std::size_t n = 0; n < roots_.size(); ++n) {
      const auto least =
          *std::min_element(roots_.begin(), roots_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return degree[a] < degree[b];
          });
      degree[least] = gone;
      ordered.push_back(least);
      for (const auto neighbour : neighbours_[least])
        if (degree[neighbour] != gone)
          --degree[neighbour];
    }
    std::reverse(ordered.begin(), ordered.end());
    return ordered;
  }

  bool colour(std::uint32_t root) {
    std::uint32_t taken = 0;
    for (const auto other : neighbours_[root])
      if (letter_[other] != no_letter)
        taken |= std::uint32_t{1} << letter_[other];
    const auto is_free = [&](std::uint8_t letter) {
      return letter < letters_ && (taken >> letter & 1) == 0;
    };
    auto& letter = letter_[root];
    each_member(classes_.members(root), [&](std::uint32_t member) {
      if (letter == no_letter && wishes_[member] != no_letter && is_free(wishes_[member]))
        letter = wishes_[member];
    });
    for (std::uint8_t any = 0; letter == no_letter && any < letters_; ++any)
      if (is_free(any))
        letter = any;
    return letter != no_letter;
  }

  const Classes& classes_;
  const std::vector<std::uint8_t>& wishes_;
  std::uint32_t letters_;
  std::vector<std::uint32_t> roots_;
  std::vector<std::vector<std::uint32_t>> neighbours_; ///< of each root: roots
  std::vector<std::uint8_t> letter_;
};

void join_copies(const Code& code, Classes& classes) {
  for (const auto& line : code.lines)
    if ((line.kind == LineKind::Let || line.kind == LineKind::For) &&
        code.terms[line.term].kind == TermKind::Variable)
      classes.join(line.variable, code.terms[line.term].left);
}

} // namespace

Letters choose_letters(const Code& code, const std::vector<std::uint8_t>& wishes) {
  const Interference interference(code);
  const auto count = code.variables.size();
  const bool index_used = interference.used[index_variable];
  Letters letters;
  letters.of.assign(count, no_letter);
  letters.available = static_cast<std::uint32_t>(spec::value_of(spec::Limit::DirectVariables)) -
                      (index_used ? 1 : 0);
  for (const bool together : {true, false}) {
    Classes classes(interference.edges, count);
    if (together)
      join_copies(code, classes);
    Colouring colouring(classes, interference.used, wishes, letters.available, index_used);
    if (!colouring.run())
      continue;
    for (std::uint32_t v = 0; v < count; ++v)
      letters.of[v] = colouring.letter(v);
    return letters;
  }
  letters.crowded_line = interference.crowded_line;
  for (std::uint32_t v = 0; v < count; ++v)
    if (contains(interference.crowd, v))
      letters.crowd.push_back(v);
  return letters;
}

} // namespace orb::structured
