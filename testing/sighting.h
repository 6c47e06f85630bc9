#pragma once

#include "testing/judge.h"

#include <limits>
#include <string>
#include <string_view>

// How far a sighting is from an expectation, and how to describe it.

namespace orb::testing {

/// The distance of an expectation that can no longer be met.
inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Distance between a sighting and an expectation with all its joined parts; 0 if met. For an
/// event, only the joined states count.
double off(const Expectation& one, const Meaning& meaning, const Sighting& s);

/// Describes a sighting in the terms of the same parts.
Message describe(const Expectation& one, const Meaning& meaning, const Sighting& s);

/// A printed line ready for display, cut if long.
std::string shown_line(std::string_view line);

/// A number with this many decimals.
std::string decimal(double value, int decimals);

/// A number without trailing zeros.
std::string plain(double value, int decimals);

} // namespace orb::testing
