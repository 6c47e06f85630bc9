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
  std::optional<spec::Robot> robot = {};        ///< which robot drives; nothing: any
};

/// What the linter has to say about an assembled file by itself, the assembler's own findings not
/// included. Targets of goto that the file does not define count as unknown. What a remark
/// `# orb: allow RULE` names is left out on its line, or on the next one when it stands alone.
std::vector<Diagnostic> lint(const Source& source, const Assembly& assembly,
                             const LintOptions& options = {});

/// All findings about one file of macro source, the assembler's and the linter's, by place.
std::vector<Diagnostic> check(const Source& source, const LintOptions& options = {});

/// The same for several files, which may lead to each other's macros. Each may go to a ball of its
/// own: ids, heap and index are those of one file. A result per source, in order, with the size of
/// the framed macros.
std::vector<FileFindings> check(std::span<const Source* const> sources,
                                const LintOptions& options = {});

/// Whether a finding of the linter keeps the bytes from being of any use: `orb asm` then writes
/// none. Whatever else a macro does wrong, its bytes can be sent.
bool cannot_be_sent(const Diagnostic& diagnostic);

} // namespace orb::assembler
