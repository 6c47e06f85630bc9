#pragma once

#include "assembler/assemble.h"

#include "spec/robots.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orb::assembler {

struct LintOptions {
  int executive = spec::macro_executive_newest; ///< version of the ball's macro executive
  std::optional<spec::Robot> robot = {};        ///< the robot that drives; nothing: any
};

/// Lints an assembled file; the assembler's own findings are not included. Targets of goto outside
/// the file count as unknown. A remark `# orb: allow RULE` silences the rule on its line, or on the
/// next one if it is alone on its line.
std::vector<Diagnostic> lint(const Source& source, const Assembly& assembly,
                             const LintOptions& options = {});

/// All findings about one macro source file, of the assembler and the linter, by place.
std::vector<Diagnostic> check(const Source& source, const LintOptions& options = {});

/// The same for several files, which may call each other's macros. Each may go to a different ball,
/// so ids, heap and index are checked per file. Returns a result per source, in order, with the
/// size of the framed macros.
std::vector<FileFindings> check(std::span<const Source* const> sources,
                                const LintOptions& options = {});

/// True if a finding of the linter makes the bytes useless, so that `orb asm` writes none. With any
/// other error the bytes can still be sent.
bool cannot_be_sent(const Diagnostic& diagnostic);

} // namespace orb::assembler
