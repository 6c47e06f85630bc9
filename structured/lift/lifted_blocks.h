#pragma once

#include "structured/lift/graph.h"

#include <cstdint>
#include <vector>

namespace orb::structured::lifting {

enum class PieceKind : std::uint8_t {
  Write,    ///< the statement of `node`; for a Test, the statements that must run before it
  Comments, ///< only the comments of `node`
  Label,    ///< of `node`
  Goto,     ///< to the label of `node`
  Exit,
  Continue,
  Leave,   ///< `return`, or `end` in the main program
  If,      ///< the condition of `node`: `first`, else `second`
  Select,  ///< by the `on` of `node`: `cases`
  For,     ///< `node` is the Begin, `end` the Close: `first`
  While,   ///< while the condition of `node` holds: `first`
  Until,   ///< `first`, until the condition of `end`
  Forever, ///< `first`
};

struct Piece;
using Pieces = std::vector<Piece>;

/// A case of a Select.
struct SelectCase {
  std::vector<std::uint32_t> values;
  Pieces pieces;
};

/// A statement or a block of a structured program.
struct Piece {
  PieceKind kind = PieceKind::Write;
  std::uint32_t node = none;
  std::uint32_t end = none;
  bool negated = false; ///< If, While, Until: negates the condition of the node
  Pieces first;
  Pieces second;
  std::vector<SelectCase> ways;
};

/// Facts about statements that the graph does not contain.
struct Hints {
  std::vector<bool> counted;  ///< by step of a `for`: it certainly runs at least once
  std::vector<bool> prepared; ///< by step of an `if`: other statements must run before its test
};

/// Structures a graph into loops and blocks. Jumps that do not fit become labels and `goto`.
Pieces make_blocks(const Graph& graph, const Hints& hints);

} // namespace orb::structured::lifting
