#pragma once

#include "base/texts.h"

/// The texts about stimulus scripts: `texts::NotAnEvent(word)`.
namespace orb::vm::texts {

using namespace orb::texts;

#define ORB_TEXTS "vm/rules.def"
#include "base/texts.inc"

} // namespace orb::vm::texts
