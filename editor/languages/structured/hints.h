#pragma once

#include "editor/language.h"
#include "editor/languages/structured/names.h"

#include <cstdint>
#include <map>
#include <vector>

namespace orb::editor {

/// The letter of the robot that holds each name of a program that compiles, by where the name is
/// declared.
std::map<std::uint32_t, char> letters_of(const structured::Compiled& compiled);

/// What the arguments of the robot's statements are, which letters hold variables, how many bytes
/// each routine takes.
std::vector<Hint> structured_hints(const Source& source, const LanguageOptions& options);

} // namespace orb::editor
