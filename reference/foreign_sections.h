#pragma once

#include "reference/knowledge.h"

#include <optional>
#include <string_view>

namespace orb::reference {

/// Translates a word or a line of another language (`setMainLed`, `roll(0, 80, 2)`) with the
/// patterns of repair/idioms.def: how each language here writes it. A single word is shown in the
/// first call of it that a pattern matches. Nothing if none matches.
std::optional<Section> foreign_knowledge(std::string_view text);

} // namespace orb::reference
