#pragma once

#include "base/texts.h"

/// The messages about structured programs: `texts::NotOfThisLanguage(word)`.
namespace orb::structured::texts {

using namespace orb::texts;

#define ORB_TEXTS "structured/text/rules.def"
#include "base/texts.inc"

} // namespace orb::structured::texts
