#pragma once

#include "base/texts.h"

/// The texts that explain why a program stopped: `texts::ToRepeat(line)`.
namespace orb::run::texts {

using namespace orb::texts;

#define ORB_TEXTS "run/texts.def"
#include "base/texts.inc"

} // namespace orb::run::texts
