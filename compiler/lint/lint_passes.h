#pragma once

#include "base/findings.h"
#include "base/fixes.h"
#include "compiler/analyse/flow.h"
#include "compiler/analyse/settings.h"
#include "compiler/lint/lint.h"
#include "compiler/text/program.h"
#include "compiler/text/texts.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace orb::compiler {

/// Adds a related place to a finding.
void add_note(Diagnostic& diagnostic, Span where, Message what);

/// The longest loop that is analysed: no robot has room for more, and a linter must not take
/// minutes.
inline constexpr std::uint32_t longest_loop = 512;

/// Degrees: the greatest heading plus one.
inline constexpr std::int32_t full_turn =
    spec::info(spec::Statement::Goroll).parameters()[0].greatest + 1;

/// The line that adds to a variable or subtracts from it: `N = N + 1`, `n += 1` for a named one.
std::string stepped(const Program& program, std::string_view name, char sign, std::int64_t step);

/// True if two spans overlap.
constexpr bool meets(Span a, Span b) {
  return a.begin < b.end && b.begin < a.end;
}

// The passes, in the order in which they run. Each traverses the program once and is independent of
// the others.

/// Reports lines without a number; one finding if all lack it, since nobody forgets it on every
/// line.
void lint_missing_numbers(const Program& program, std::span<const Fault* const> faults,
                          Findings& findings);

/// Lints the text: bytes and line numbers.
void lint_text(const Program& program, const Flow& flow, Findings& findings);

/// Lints how statements are written: words, spaces, jump targets, notation of expressions.
void lint_statements(const Program& program, const Flow& flow, const Target& target,
                     Findings& findings);

/// Reports features that the target firmware does not have yet.
void lint_age(const Program& program, const Target& target, Findings& findings);

/// Known if all jumps of a program could be read. Otherwise values are valid only up to the next
/// line.
enum class Jumps : std::uint8_t { Known, Unknown };

/// Lints the values of letters, parameters and data. Returns true if some value may stop the
/// program, so that a trial is worth its time.
bool lint_values(const Program& program, const Flow& flow, const Target& target, Jumps jumps,
                 Findings& findings);

/// Lints how `for` and `next` pair on all paths.
void lint_loops(const Program& program, const Flow& flow, Findings& findings);

/// Lints jumps, loops and subroutines.
void lint_flow(const Program& program, const Flow& flow, Findings& findings);

/// Finds programs that run without an error but not as intended: colours and rolls that nobody
/// sees, a ball left driving.
void lint_effects(const Program& program, const Flow& flow, Findings& findings);

/// Finds numbers in the wrong unit, and comparisons with a constant result.
void lint_units(const Program& program, const Flow& flow, Findings& findings);

/// Finds loops that wait for an impossible event, and loops used as a delay.
void lint_waits(const Program& program, const Flow& flow, const Settings& settings,
                Findings& findings);

/// Finds programs that run without an error but cannot be intended: loops that end at once or
/// never, tests that the ball's own path decides.
void lint_meant(const Program& program, const Flow& flow, const Settings& settings,
                Findings& findings);

/// Finds changes of variables that have no effect, or not the one that the next test waits for.
void lint_updates(const Program& program, const Flow& flow, const Settings& settings,
                  Findings& findings);

/// Finds computations that lose their result: swaps, sums, products, percentages.
void lint_sums(const Program& program, const Flow& flow, Findings& findings);

/// Reports certain faults. For the first value that stops the program on its only path, a warning
/// becomes an error; a fault without a warning is added.
void lint_certain(const Program& program, const Flow& flow, Findings& findings);

/// Reports features that the robot lacks.
void lint_robot(const Program& program, spec::Robot robot, Findings& findings);

} // namespace orb::compiler
