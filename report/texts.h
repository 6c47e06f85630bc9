#pragma once

#include "base/texts.h"

/// The texts about courses: `texts::NoStart()`.
namespace orb::report::texts {

using namespace orb::texts;

#define ORB_TEXTS "report/rules.def"
#include "base/texts.inc"

} // namespace orb::report::texts
