#pragma once

#include "editor/language.h"

namespace orb::editor {

/// Suggests what can follow at `offset` of an orbBasic program: statements, variables, the number
/// of a new line, rules in an allow comment.
Suggestions suggest_basic(const Source& source, std::uint32_t offset,
                          const LanguageOptions& options);

} // namespace orb::editor
