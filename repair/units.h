#pragma once

#include "base/units.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::repair {

/// The unit of a measure for a word in any of the languages; nothing if it is not one.
const Unit* unit_called(std::string_view word, Measure measure);

/// The milliseconds in a unit of time, in any of the languages; 0 if it is not one.
std::int64_t milliseconds_of(std::string_view word);

/// Parses a number with up to three decimals into thousandths.
std::optional<std::int64_t> thousandths_in(std::string_view number);

} // namespace orb::repair
