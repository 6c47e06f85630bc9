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
  Program program; ///< refers to the text that was checked
  std::vector<Diagnostic> diagnostics;
  std::optional<std::size_t> image_bytes; ///< of the plain image; nothing where none can be built
};

/// Parses a whole file, without a check: the one finding says why it is no program at all (empty,
/// binary or huge). `text` must outlive the result.
Checked read(std::string_view text);

/// All that is to be said about a program that was read without a finding, with the lines to write.
std::vector<Diagnostic> check(const Program& program, const Target& target);

/// Both: first whether a file is a program, then every line of it.
Checked check(std::string_view text, const Target& target);

/// What speaks against a whole text: it is binary, or larger than any program. Nothing for a text
/// that can be looked into.
std::optional<Diagnostic> refuse_text(std::string_view text);

/// Makes every safe fix, again and again until none is left: fixing the result changes nothing
/// more.
Fixed fix(std::string text, const Target& target);

} // namespace orb::compiler
