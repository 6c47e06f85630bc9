#pragma once

#include "structured/lift/control_flow.h"

#include <cstdint>
#include <vector>

namespace orb::structured::lifting {

enum class NodeKind : std::uint8_t {
  Exit,      ///< the end of the routine; always the first node
  Statement, ///< has one successor
  Empty,     ///< the same, but only the comments of its line are written
  Test,      ///< successors: if the condition holds, if it does not
  Choice,    ///< `on … goto`: a successor for each target
  Begin,     ///< `for`; its successor is the Head of its loop
  Head,      ///< of a loop; nothing to write
  Close,     ///< `next`; successors: the Head of its loop, what is after the loop
  Tail,      ///< falls through into another subroutine: calls it and leaves
  Stop,      ///< ends the program
};

struct Node {
  NodeKind kind = NodeKind::Statement;
  std::uint32_t step = none; ///< none: a Head made for a loop; a Stop after the last line
  std::uint32_t sub = none;  ///< Tail: index into ControlFlow::subroutines
  std::vector<std::uint32_t> successors;

  // Computed by make_graph():
  std::vector<std::uint32_t> predecessors;
  std::uint32_t rank = none;      ///< its position in reverse postorder; none if unreachable
  std::uint32_t dominator = none; ///< its immediate dominator
  std::uint32_t loop = none;      ///< the innermost loop around it
};

/// A natural loop: the nodes that can reach `head` again without leaving it.
struct Loop {
  std::uint32_t head = none;
  std::uint32_t parent = none;        ///< the enclosing loop
  std::vector<bool> members;          ///< by node
  std::vector<std::uint32_t> latches; ///< the nodes with an edge back to the head
};

/// The control-flow graph of one routine. A statement that two routines reach is in both.
struct Graph {
  std::vector<Node> nodes;
  std::vector<Loop> loops; ///< outer ones before inner ones
  std::uint32_t entry = none;
  bool is_main = false;

  bool dominates(std::uint32_t above, std::uint32_t below) const;
  bool in_loop(std::uint32_t node, std::uint32_t loop) const {
    return loop != none && loops[loop].members[node];
  }
};

/// Makes the graph of the main program (`first` is none), or of the subroutine that begins at a
/// step.
Graph make_graph(const compiler::Program& program, const ControlFlow& ways, std::uint32_t first);

} // namespace orb::structured::lifting
