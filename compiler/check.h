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

/// Checks a whole file: first whether it is a program at all (an empty, a binary or a huge file is
/// one finding), then every line of it. `text` must outlive the result.
Checked check(std::string_view text, const Target& target);

/// What speaks against a whole text: it is binary, or larger than any program. Nothing for a text
/// that can be looked into.
std::optional<Diagnostic> refuse_text(std::string_view text);

/// Makes every safe fix, again and again until none is left: fixing the result changes nothing
/// more.
Fixed fix(std::string text, const Target& target);

} // namespace orb::compiler
