#pragma once

#include "base/rules.h"

/// The rules for stimulus scripts: `rules::StimulusSyntax`.
namespace orb::vm::rules {

#define ORB_RULES "vm/rules.def"
#include "base/rules.inc"

} // namespace orb::vm::rules
