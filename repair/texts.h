#pragma once

#include "base/texts.h"

/// What is said beside and around the lines to write: `texts::WholeNumbers()`.
namespace orb::repair::texts {

using namespace orb::texts;

#define ORB_TEXTS "repair/texts.def"
#include "base/texts.inc"

} // namespace orb::repair::texts
