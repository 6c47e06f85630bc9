#pragma once

#include "assembler/lint/lint.h"
#include "base/diagnostic.h"
#include "run/input.h"
#include "structured/text/files.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace orb::run {

/// What is said about files, which it refers to; after each the included ones that something is
/// said about.
struct Findings {
  std::vector<FileFindings> files;
  std::deque<Source> included;
};

/// Checks programs, macros and courses. Macros are checked together: they go to one ball and call
/// each other. Of tests nothing is said: testing::check_tests() does.
Findings check_files(std::span<const SourceFile> sources, const compiler::Target& target,
                     const assembler::LintOptions& macro, structured::Files& files);

/// Makes the safe fixes of what `findings` says of a file until none is left; how many.
std::size_t fix(SourceFile& file,
                const std::function<std::vector<Diagnostic>(const SourceFile&)>& findings);

} // namespace orb::run
