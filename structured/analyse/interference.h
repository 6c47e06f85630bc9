#pragma once

#include "structured/analyse/flow.h"

#include <cstdint>
#include <span>
#include <vector>

namespace orb::structured {

/// The interference graph: variables that hold different values at the same time cannot share a
/// letter.
class Interference {
public:
  explicit Interference(const Code& code);

private:
  const Code& code_;
  Flow flow_;
  Liveness liveness_;

public:
  VariableSets edges;
  std::vector<bool> used;
  std::uint32_t crowded_line = none; ///< the line with the most live variables
  std::vector<std::uint64_t> crowd;  ///< those variables
  std::size_t pressure = 0;          ///< their number

private:
  std::vector<std::uint64_t> live_;

  void read_block(std::uint32_t b);

  /// Separates the counters of loops that are open at the same time, even if the outer value is not
  /// needed: a `for` with the variable of an open loop replaces that loop.
  void part_loops();
  void measure(std::uint32_t line, const std::vector<std::uint64_t>& live);
  void add_edges(const CodeLine& line, std::uint32_t variable, std::span<const std::uint64_t> live);
  void add_edge(std::uint32_t a, std::uint32_t b);
};

/// Classes of variables that share a letter because they are copies of each other.
class Classes {
public:
  explicit Classes(VariableSets edges, std::size_t count);

  std::uint32_t find(std::uint32_t v) const {
    while (parent_[v] != v)
      v = parent_[v];
    return v;
  }
  bool join(std::uint32_t a, std::uint32_t b);

  std::span<const std::uint64_t> members(std::uint32_t root) const { return members_[root]; }
  std::span<const std::uint64_t> edges(std::uint32_t root) const { return edges_[root]; }

private:
  bool meet(std::uint32_t a, std::uint32_t b) const;

  VariableSets edges_;
  VariableSets members_;
  std::vector<std::uint32_t> parent_;
};

/// Calls `visit` with the target and the source of each copy.
template <typename Visit>
void each_copy(const Code& code, Visit visit) {
  for (const auto& line : code.lines)
    if ((line.kind == LineKind::Let || line.kind == LineKind::For) &&
        code.terms[line.term].kind == TermKind::Variable)
      visit(line.variable, code.terms[line.term].left);
}

} // namespace orb::structured
