#pragma once

#include "base/units.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::repair {

/// The unit of that measure that a word means, in any of the languages; nothing for other words.
const Unit* unit_called(std::string_view word, Measure measure);

/// How many milliseconds a unit of time is, in any of the languages; 0 for other words.
std::int64_t milliseconds_of(std::string_view word);

/// A number with up to three decimal places, in thousandths.
std::optional<std::int64_t> thousandths_in(std::string_view number);

} // namespace orb::repair
