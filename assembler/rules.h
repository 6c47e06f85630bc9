#pragma once

#include "base/diagnostic.h"

#include <span>
#include <string_view>

namespace orb::assembler::rules {

// One constant per row of assembler/rules.def: `rules::UnknownCommand`.
#define ORB_RULE(name, ...) extern const Rule& name;
#include "assembler/rules.def"
#undef ORB_RULE

/// Every rule about macros, in the order of the table.
std::span<const Rule> all();

/// The rule of that id, or null.
const Rule* find(std::string_view id);

} // namespace orb::assembler::rules
