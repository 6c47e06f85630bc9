#pragma once

#include "editor/language.h"

namespace orb::editor {

/// Suggests what can follow at `offset` of a structured program: words, visible names, rules in an
/// allow comment.
Suggestions suggest_structured(const Source& source, std::uint32_t offset,
                               const LanguageOptions& options);

} // namespace orb::editor
