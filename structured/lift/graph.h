#pragma once

#include "structured/lift/ways.h"

#include <cstdint>
#include <vector>

namespace orb::structured::lifting {

enum class NodeKind : std::uint8_t {
  Exit,      ///< the end of the routine; always the first node
  Statement, ///< goes on at its successor
  Empty,     ///< the same, with nothing to write but the comments of its line
  Test,      ///< successors: where the condition holds, where it does not
  Choice,    ///< `on … goto`: a successor for each target
  Begin,     ///< `for`; its successor is the Head of its loop
  Head,      ///< of a loop; nothing to write
  Close,     ///< `next`; successors: the Head of its loop, what is after the loop
  Tail,      ///< runs on into another subroutine: calls it and leaves
  Stop,      ///< ends the program
};

struct Node {
  NodeKind kind = NodeKind::Statement;
  std::uint32_t step = none; ///< none: a Head made for a loop; a Stop after the last line
  std::uint32_t sub = none;  ///< Tail: index into Ways::subroutines
  std::vector<std::uint32_t> successors;

  // What is computed of it.
  std::vector<std::uint32_t> predecessors;
  std::uint32_t rank = none;      ///< its place in reverse postorder; none where nothing reaches it
  std::uint32_t dominator = none; ///< the last node that every way to it passes
  std::uint32_t loop = none;      ///< the innermost one that it is in
};

/// The nodes from which a way leads back to `head` without leaving it.
struct Loop {
  std::uint32_t head = none;
  std::uint32_t parent = none;        ///< the loop around it
  std::vector<bool> members;          ///< by node
  std::vector<std::uint32_t> latches; ///< the nodes that lead back to the head
};

/// The statements of one routine and where they lead. A statement that two routines reach is in
/// both.
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

/// The graph of the main program, for `first` none, or of the subroutine that begins at a step.
Graph make_graph(const compiler::Program& program, const Ways& ways, std::uint32_t first);

} // namespace orb::structured::lifting
