#pragma once

#include "base/rules.h"

/// The rules about macros: `rules::UnknownCommand`.
namespace orb::assembler::rules {

#define ORB_RULES "assembler/text/rules.def"
#include "base/rules.inc"

} // namespace orb::assembler::rules
