#pragma once

#include "base/rules.h"

/// The rules about structured programs: `rules::UnknownName`. What the compiled program gives cause
/// for is said by the rules of compiler/.
namespace orb::structured::rules {

#define ORB_RULES "structured/text/rules.def"
#include "base/rules.inc"

} // namespace orb::structured::rules
