#pragma once

#include "base/diagnostic.h"

#include <span>
#include <string_view>

namespace orb::compiler::rules {

// One constant per row of compiler/rules.def: `rules::UnknownStatement`.
#define ORB_RULE(name, ...) extern const Rule& name;
#include "compiler/rules.def"
#undef ORB_RULE

/// Every rule about orbBasic programs, in the order of the table.
std::span<const Rule> all();

/// The rule of that id, or null.
const Rule* find(std::string_view id);

} // namespace orb::compiler::rules
