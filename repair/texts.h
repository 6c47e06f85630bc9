#pragma once

#include "base/texts.h"

/// The messages beside and around replacement lines: `texts::WholeNumbers()`.
namespace orb::repair::texts {

using namespace orb::texts;

#define ORB_TEXTS "repair/texts.def"
#include "base/texts.inc"

} // namespace orb::repair::texts
