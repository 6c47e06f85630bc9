#pragma once

#include "base/diagnostic.h"
#include "base/fixes.h"
#include "compiler/lint/lint.h"
#include "compiler/text/program.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::compiler {

/// A source file after checking.
struct Checked {
  Program program; ///< refers to the checked text
  std::vector<Diagnostic> diagnostics;
  std::optional<std::size_t> image_bytes; ///< size of the plain image; nothing if it cannot be
                                          ///< built
};

/// Parses a whole file without checking it. Its only finding says why the file is not a program
/// (empty, binary or huge). `text` must outlive the result.
Checked read(std::string_view text);

/// Returns all findings about a program that was read without a finding, with replacement lines.
std::vector<Diagnostic> check(const Program& program, const Target& target);

/// Reads and checks a file.
Checked check(std::string_view text, const Target& target);

/// Rejects a text that is binary, or larger than any program; returns nothing if it is acceptable.
std::optional<Diagnostic> refuse_text(std::string_view text);

/// Applies the safe fixes until none is left, so that fixing the result changes nothing.
Fixed fix(std::string text, const Target& target);

} // namespace orb::compiler
