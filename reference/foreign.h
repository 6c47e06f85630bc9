#pragma once

#include "reference/knowledge.h"

#include <optional>
#include <string_view>

namespace orb::reference {

/// What a word or a line of another language (`setMainLed`, `roll(0, 80, 2)`) is here, by the
/// patterns of repair/idioms.def: how each language writes it. A word alone is shown in the first
/// call of it that a pattern knows. Nothing where none does.
std::optional<Section> foreign_knowledge(std::string_view text);

} // namespace orb::reference
