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

/// Findings, which refer to the checked files. Included files with findings follow the file that
/// includes them.
struct Findings {
  std::vector<FileFindings> files;
  std::deque<Source> included;
};

/// Checks programs, macros and courses. Macros are checked together, because they share a ball and
/// call each other. Tests are left to testing::check_tests().
Findings check_files(std::span<const SourceFile> sources, const compiler::Target& target,
                     const assembler::LintOptions& macro, structured::Files& files);

/// Applies safe fixes until `findings` reports none. Returns how many.
std::size_t fix(SourceFile& file,
                const std::function<std::vector<Diagnostic>(const SourceFile&)>& findings);

} // namespace orb::run
