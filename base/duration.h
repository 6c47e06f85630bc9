#pragma once

#include "base/time.h"
#include "base/units.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb {

inline constexpr std::array time_units{unit::ms, unit::s, unit::min, unit::h};

/// Parses a time with a unit, to the nanosecond: `250ms`, `2.5s`, `2min`, `1h`. A number without a
/// unit counts in `bare`; if `bare` is zero, the unit is required. Returns nothing if `text` is
/// malformed, negative or longer than a year.
std::optional<Duration> parse_duration(std::string_view text, Duration bare = {});

/// Prints milliseconds in the form that parse_duration() reads: `2s`, `250ms`.
std::string time_text(std::int64_t ms);

} // namespace orb
