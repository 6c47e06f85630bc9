#pragma once

#include "base/diagnostic.h"

#include <span>
#include <string_view>

namespace orb::structured::rules {

// One constant per row of structured/rules.def: `rules::UnknownName`.
#define ORB_RULE(name, ...) extern const Rule& name;
#include "structured/rules.def"
#undef ORB_RULE

/// Every rule about structured programs, in the order of the table. What the compiled program gives
/// cause for is said by the rules of compiler/.
std::span<const Rule> all();

/// The rule of that id, or null.
const Rule* find(std::string_view id);

} // namespace orb::structured::rules
