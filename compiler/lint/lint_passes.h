#pragma once

#include "base/diagnostic.h"
#include "base/findings.h"
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

/// Adds a place that belongs to a finding.
void add_note(Diagnostic& diagnostic, Span where, Message what);

/// Beyond these no area of the robot holds a loop, and a linter must not take minutes over one.
inline constexpr std::uint32_t longest_loop = 512;

/// Degrees: one more than the greatest heading.
inline constexpr std::int32_t full_turn =
    spec::info(spec::Statement::Goroll).parameters()[0].greatest + 1;

/// A fix of one edit.
inline Fix single_fix(Message title, Span span, std::string text, Safety safety = Safety::Safe) {
  return Fix{std::move(title), {Edit{span, std::move(text)}}, safety};
}

/// The line that adds to a variable, or takes away: `N = N + 1`, `n += 1` where it has a name.
std::string stepped(const Program& program, std::string_view name, char sign, std::int64_t step);

// The passes, in the order in which they run. Each goes once through the program and knows nothing
// of the others.

/// The lines that lack a number: one finding where all do, as nobody forgets it on every line.
void lint_missing_numbers(const Program& program, std::span<const Fault* const> faults,
                          Findings& findings);

/// What can be said of the text without computing anything: bytes, line numbers, words, blanks,
/// targets, how expressions are written.
void lint_text(const Program& program, const Flow& flow, const Target& target, Findings& findings);

/// What the firmware that the program is meant for does not have yet.
void lint_age(const Program& program, const Target& target, Findings& findings);

/// Whether all jumps of a program could be read; otherwise values hold to the next line at most.
enum class Jumps : std::uint8_t { Known, Unknown };

/// What follows from the values that letters, parameters and data can have.
void lint_values(const Program& program, const Flow& flow, const Target& target, Jumps jumps,
                 Findings& findings);

/// The rules about loops: how `for` and `next` meet on every way.
void lint_loops(const Program& program, const Flow& flow, Findings& findings);

/// The rules about jumps, loops and subroutines.
void lint_flow(const Program& program, const Flow& flow, Findings& findings);

/// What runs through and is still not meant: colours and rolls that nobody sees, a ball left
/// driving.
void lint_intent(const Program& program, const Flow& flow, Findings& findings);

/// Numbers in another unit than the one that counts there, comparisons with but one answer.
void lint_units(const Program& program, const Flow& flow, Findings& findings);

/// Loops that wait for what cannot come, and loops that are meant as a wait.
void lint_waits(const Program& program, const Flow& flow, const Settings& settings,
                Findings& findings);

/// Programs that run as they are written, which cannot be what was meant: loops that are over at
/// once or never, tests that the ball's own way decides.
void lint_meant(const Program& program, const Flow& flow, const Settings& settings,
                Findings& findings);

/// What is computed and lost on the way: values exchanged, sums, products, shares.
void lint_sums(const Program& program, const Flow& flow, Findings& findings);

/// What happens for certain: of the first value that stops the program on its only way, a warning
/// becomes an error, and what nothing warned of is said.
void lint_certain(const Program& program, const Flow& flow, Findings& findings);

/// What the robot does not have.
void lint_robot(const Program& program, spec::Robot robot, Findings& findings);

} // namespace orb::compiler
