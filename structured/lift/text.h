#pragma once

#include "structured/lift/blocks.h"
#include "structured/lift/names.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::structured::lifting {

/// What can only be known of the program as a whole.
struct Proofs {
  std::vector<bool> counted; ///< by step of a `for`: its start is never past its end
  std::vector<bool> covered; ///< by step of an `on`: it always finds a line
};

struct LiftedText {
  std::string text;
  std::vector<std::uint32_t> lines; ///< of each line that is not blank: the numbered line it is of
  std::vector<std::uint32_t> loops; ///< steps of the `for`s in it, in the order of the text
  std::vector<std::uint32_t>
      choices; ///< steps of the `on`s that it stops at where they find no line
};

/// How many lines that are not blank end before a place in a text.
std::size_t not_blank(std::string_view text, std::size_t end);

/// Writes the graphs of a program's routines, the main program first, as a structured program.
LiftedText write_text(const compiler::Program& program, const Ways& ways, const Comments& comments,
                      const std::vector<Graph>& graphs, const Proofs& proofs);

} // namespace orb::structured::lifting
