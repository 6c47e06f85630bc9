#pragma once

#include "base/texts.h"

#include <string_view>

/// The messages about orbBasic programs: `texts::NotAStatement(word)`.
namespace orb::compiler::texts {

using namespace orb::texts;

#define ORB_TEXTS "compiler/text/rules.def"
#include "base/texts.inc"

/// Finds the message for words of a table of spec/, such as the name of a parameter.
inline Message of_table(std::string_view words) {
  return find_text(all(), words);
}

} // namespace orb::compiler::texts
