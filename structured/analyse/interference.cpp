#include "structured/analyse/interference.h"

#include <bit>
#include <numeric>
#include <utility>

namespace orb::structured {

Interference::Interference(const Code& code)
    : code_(code), flow_(read_flow(code)), liveness_(read_liveness(code, flow_)),
      edges(code.variables.size(), code.variables.size()), used(code.variables.size(), false) {
  for (std::uint32_t v = 0; v < code.variables.size(); ++v)
    used[v] = code.variables[v].kept;
  for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
    read_block(b);
  part_loops();
}

void Interference::part_loops() {
  VariableSets counted(code_.routines.size(), code_.variables.size()); // including callees
  for (const auto& line : code_.lines)
    if (line.kind == LineKind::For)
      insert(counted[line.routine], line.variable);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& line : code_.lines)
      if (const auto callee = callee_of(line); callee != none)
        changed = unite(counted[line.routine], counted[callee]) || changed;
  }
  std::vector<const CodeLine*> open; // the enclosing `for` loops
  for (const auto& line : code_.lines) {
    const auto callee = callee_of(line);
    for (const auto* loop : open) {
      if (line.kind == LineKind::For)
        add_edge(loop->variable, line.variable);
      if (callee != none)
        each_member(counted[callee], [&](std::uint32_t v) { add_edge(loop->variable, v); });
    }
    if (line.kind == LineKind::For)
      open.push_back(&line);
    else if (line.kind == LineKind::Next)
      std::erase_if(open, [&](const CodeLine* loop) {
        return loop->label == line.label && line.step != 0; // 0: on an exit from the loop
      });
  }
}

void Interference::read_block(std::uint32_t b) {
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
    // The end of a loop is computed after its variable is set.
    if (line.kind == LineKind::For)
      each_read(code_, line.end, [&](std::uint32_t v) { add_edge(line.variable, v); });
    step_back(code_, flow_, liveness_, line, live);
    measure(i, live);
  }
}

void Interference::measure(std::uint32_t line, const std::vector<std::uint64_t>& live) {
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

void Interference::add_edges(const CodeLine& line, std::uint32_t variable,
                             std::span<const std::uint64_t> live) {
  const auto& term = line.kind == LineKind::Let ? code_.terms[line.term] : Term{};
  const auto source = term.kind == TermKind::Variable ? term.left : none;
  each_member(live, [&](std::uint32_t other) {
    if (other != source)
      add_edge(variable, other);
  });
}

void Interference::add_edge(std::uint32_t a, std::uint32_t b) {
  if (a == b)
    return;
  insert(edges[a], b);
  insert(edges[b], a);
}

Classes::Classes(VariableSets edges, std::size_t count)
    : edges_(std::move(edges)), members_(count, count), parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0U);
  for (std::uint32_t v = 0; v < count; ++v)
    insert(members_[v], v);
}

bool Classes::meet(std::uint32_t a, std::uint32_t b) const {
  const auto edges = edges_[a];
  const auto members = members_[b];
  for (std::size_t w = 0; w < edges.size(); ++w)
    if ((edges[w] & members[w]) != 0)
      return true;
  return false;
}

bool Classes::join(std::uint32_t a, std::uint32_t b) {
  a = find(a);
  b = find(b);
  if (a == b || meet(a, b))
    return false;
  if (b == index_variable)
    std::swap(a, b);
  parent_[b] = a;
  unite(edges_[a], edges_[b]);
  unite(members_[a], members_[b]);
  return true;
}

} // namespace orb::structured
