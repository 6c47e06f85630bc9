#pragma once

#include "base/rules.h"

/// The rules about structured programs: `rules::UnknownName`. Findings about the compiled program
/// use the rules of compiler/.
namespace orb::structured::rules {

#define ORB_RULES "structured/text/rules.def"
#include "base/rules.inc"

} // namespace orb::structured::rules
