#pragma once

#include "editor/language.h"

namespace orb::editor {

/// What can stand at `offset` of a structured program: words, names that are known there, rules in
/// a comment that allows one.
Suggestions suggest_structured(const Source& source, std::uint32_t offset,
                               const LanguageOptions& options);

} // namespace orb::editor
