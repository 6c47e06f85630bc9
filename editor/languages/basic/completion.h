#pragma once

#include "editor/language.h"

namespace orb::editor {

/// What can stand at `offset` of an orbBasic program: statements, variables, the number of a new
/// line, rules in a comment that allows one.
Suggestions suggest_basic(const Source& source, std::uint32_t offset,
                          const LanguageOptions& options);

} // namespace orb::editor
