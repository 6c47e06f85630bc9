#pragma once

#include "assembler/lint/lint.h"
#include "base/diagnostic.h"
#include "compiler/text/image.h"
#include "run/input.h"
#include "structured/text/files.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace orb::testing {

/// Whether a file is something else than a program or a macro: a course or tests.
bool is_no_program(std::string_view file_name);

/// What is said about files, which it refers to; after each the included ones that something is
/// said about.
struct Findings {
  std::vector<FileFindings> files;
  std::deque<Source> included;
};

/// Checks programs, macros, courses and tests. Macros are checked together: they go to one ball and
/// call each other. The language of what is_no_program() does not count.
Findings check_files(std::span<const run::SourceFile> sources, const compiler::Target& target,
                     const assembler::LintOptions& macro, structured::Files& files);

/// Makes the safe fixes of what `findings` says of a file until none is left; how many.
std::size_t fix(run::SourceFile& file,
                const std::function<std::vector<Diagnostic>(const run::SourceFile&)>& findings);

} // namespace orb::testing
