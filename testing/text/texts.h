#pragma once

#include "base/texts.h"

/// What is said about test files: `file_texts::UnknownExpectation(word)`. What `orb test` says of
/// runs is in testing/texts.h.
namespace orb::testing::file_texts {

using namespace orb::texts;

#define ORB_TEXTS "testing/text/rules.def"
#include "base/texts.inc"

} // namespace orb::testing::file_texts
