#pragma once

#include "base/rules.h"

/// The rules about test files: `rules::Word`.
namespace orb::testing::rules {

#define ORB_RULES "testing/text/rules.def"
#include "base/rules.inc"

} // namespace orb::testing::rules
