#pragma once

#include "base/time.h"

#include <optional>
#include <string_view>

namespace orb {

/// The time that people write: `250ms`, `2.5s`, `2min`, `1h`, to the nanosecond. A number without a
/// unit counts in `bare`; where that is zero, a unit is required. Nothing where `text` is
/// not a time, is negative or longer than a year.
std::optional<Duration> parse_duration(std::string_view text, Duration bare = {});

} // namespace orb
