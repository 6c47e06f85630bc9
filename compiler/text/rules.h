#pragma once

#include "base/rules.h"

/// The rules about orbBasic programs: `rules::UnknownStatement`.
namespace orb::compiler::rules {

#define ORB_RULES "compiler/text/rules.def"
#include "base/rules.inc"

} // namespace orb::compiler::rules
