#pragma once

#include "repair/tokens.h"

#include <string>
#include <string_view>

namespace orb::repair {

/// Converts to lower case without accents: `Arrêter` becomes `arreter`.
std::string plain_letters(std::string_view word);

/// The word of the tables that `word` is an inflection of, in any of their languages: `desvanecer`
/// gives `desvanece`, `VERZÖGERUNG` gives `verzögere`. A word of the tables gives itself. Empty if
/// none is close.
std::string_view known_form_of(std::string_view word, Language language);

} // namespace orb::repair
