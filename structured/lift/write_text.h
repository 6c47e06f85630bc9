#pragma once

#include "structured/lift/letter_names.h"
#include "structured/lift/lifted_blocks.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::structured::lifting {

/// Facts that depend on the whole program.
struct Proofs {
  std::vector<bool> counted; ///< by step of a `for`: its start is never past its end
  std::vector<bool> covered; ///< by step of an `on`: it always finds a line
};

struct LiftedText {
  std::string text;
  std::vector<std::uint32_t> lines; ///< of each non-blank line: its numbered line
  std::vector<std::uint32_t> loops; ///< steps of its `for` loops, in text order
  std::vector<std::uint32_t>
      choices; ///< steps of each `on` in it that stops the program without a match
};

/// The number of non-blank lines that end before an offset of a text.
std::size_t not_blank(std::string_view text, std::size_t end);

/// Writes the graphs of a program's routines, the main program first, as a structured program.
LiftedText write_text(const compiler::Program& program, const ControlFlow& ways,
                      const Comments& comments, const std::vector<Graph>& graphs,
                      const Proofs& proofs);

} // namespace orb::structured::lifting
