#pragma once

#include "base/texts.h"

/// Texts of findings about test files: `file_texts::UnknownExpectation(word)`. Those of `orb test`
/// about runs are in testing/texts.h.
namespace orb::testing::file_texts {

using namespace orb::texts;

#define ORB_TEXTS "testing/text/rules.def"
#include "base/texts.inc"

} // namespace orb::testing::file_texts
