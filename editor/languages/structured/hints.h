#pragma once

#include "editor/language.h"
#include "editor/languages/structured/structured_names.h"

#include <cstdint>
#include <map>
#include <vector>

namespace orb::editor {

/// The letter that holds each name of a compiled program, by place of the declaration.
std::map<std::uint32_t, char> letters_of(const structured::Compiled& compiled);

/// Hints: parameter names of the robot's statements, the letters of variables, the bytes of each
/// routine.
std::vector<Hint> structured_hints(const Source& source, const LanguageOptions& options);

} // namespace orb::editor
