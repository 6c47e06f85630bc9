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

/// A statement of a numbered program that can run: that of a line, or one after its `then` or
/// `else`.
struct Step {
  std::uint32_t statement = none; ///< in compiler::Program
  std::uint32_t line = none;      ///< in compiler::Program
  bool begins_line = false;
  std::uint32_t next = none; ///< the step of the line below; `Ways::end()` after the last
  std::uint32_t otherwise =
      none; ///< `if`: the step after `else`; the one after `then` is the next in the array
  std::vector<std::uint32_t> targets; ///< of `goto`, `gosub` and `on`
  std::uint32_t loop = none;          ///< `next`: the step of its `for`
  bool reached = false;
  bool remarked = false; ///< comments stand above it or at the end of its line
};

/// Where a numbered program can go, with its open loops and calls.
struct Ways {
  std::vector<Step> steps;
  std::vector<std::uint32_t> subroutines; ///< their first steps, ascending
  std::optional<Diagnostic> obstacle;     ///< why no structured program can do the same

  std::uint32_t end() const { return static_cast<std::uint32_t>(steps.size()); }
};

inline const compiler::StatementNode& statement_of(const compiler::Program& program,
                                                   const Ways& ways, std::uint32_t step) {
  return program.statements[ways.steps[step].statement];
}

/// Follows every way through a program that has no errors: each step with the loops and calls that
/// can be open there. A program that could stop with an error about its jumps, which structured
/// programs cannot make, has an obstacle.
Ways read_ways(const compiler::Program& program);

/// Why a program cannot be lifted.
Diagnostic obstacle(Span span, Message message, Message help = {});

} // namespace orb::structured::lifting
