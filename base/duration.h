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

/// The time that people write, with one of those units: `250ms`, `2.5s`, `2min`, `1h`, to the
/// nanosecond. A number without a unit counts in `bare`; where that is zero, a unit is required.
/// Nothing where `text` is not a time, is negative or longer than a year.
std::optional<Duration> parse_duration(std::string_view text, Duration bare = {});

/// A time in milliseconds as people write it, and as parse_duration() reads it: `2s`, `250ms`.
std::string time_text(std::int64_t ms);

} // namespace orb
