#pragma once

#include "base/texts.h"

/// The messages about macros: `texts::NotACommand(word)`.
namespace orb::assembler::texts {

using namespace orb::texts;

#define ORB_TEXTS "assembler/text/rules.def"
#include "base/texts.inc"

} // namespace orb::assembler::texts
