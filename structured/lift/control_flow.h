#pragma once

#include "base/diagnostic.h"
#include "compiler/analyse/flow.h"
#include "compiler/text/program.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orb::structured::lifting {

inline constexpr std::uint32_t none = 0xFFFFFFFF;

/// A reachable statement of a numbered program: that of a line, or one after its `then` or `else`.
struct Step {
  std::uint32_t statement = none; ///< in compiler::Program
  std::uint32_t line = none;      ///< in compiler::Program
  bool begins_line = false;
  std::uint32_t next = none; ///< the step of the line below; `ControlFlow::end()` after the last
  std::uint32_t otherwise =
      none; ///< `if`: the step after `else`; the one after `then` is the next in the array
  std::vector<std::uint32_t> targets; ///< of `goto`, `gosub` and `on`
  std::uint32_t loop = none;          ///< `next`: the step of its `for`
  bool reached = false;
  bool remarked = false; ///< has comments above it or at the end of its line
};

/// The control flow of a numbered program, with its open loops and calls.
struct ControlFlow {
  std::vector<Step> steps;
  std::vector<std::uint32_t> subroutines; ///< their first steps, ascending
  std::optional<Diagnostic> obstacle;     ///< why no structured program can do the same

  std::uint32_t end() const { return static_cast<std::uint32_t>(steps.size()); }
};

inline const compiler::StatementNode& statement_of(const compiler::Program& program,
                                                   const ControlFlow& ways, std::uint32_t step) {
  return program.statements[ways.steps[step].statement];
}

/// Follows all paths of a program without errors: each step with the loops and calls that can be
/// open there. A program that could stop with a jump error has an obstacle, because structured
/// programs cannot do that.
ControlFlow read_ways(const compiler::Program& program);

/// Makes the finding that a program cannot be lifted.
Diagnostic obstacle(Span span, Message message, Message help = {});

} // namespace orb::structured::lifting
