#pragma once

#include "base/texts.h"

/// Texts of `orb test`: `texts::NotText(file)`.
namespace orb::testing::texts {

using namespace orb::texts;

#define ORB_TEXTS "testing/texts.def"
#include "base/texts.inc"

} // namespace orb::testing::texts
