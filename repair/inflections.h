#pragma once

#include "repair/tokens.h"

#include <string>
#include <string_view>

namespace orb::repair {

/// In small letters without accents: `Arrêter` is `arreter`.
std::string plain_letters(std::string_view word);

/// The word of the tables that `word` is a form of, in any of their languages: `desvanecer` is
/// `desvanece`, `VERZÖGERUNG` is `verzögere`, and each of them itself. Empty where none is near.
std::string_view known_form_of(std::string_view word, Language language);

} // namespace orb::repair
