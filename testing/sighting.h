#pragma once

#include "testing/judge.h"

#include <limits>
#include <string>
#include <string_view>

// What states make of a sighting: how far it is from what is expected, and in which words.

namespace orb::testing {

/// How far off is what cannot be met any more.
inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// How far a sighting is from what is expected of it and of all that is joined; 0 where it is met.
/// Of what happens only the joined states count.
double off(const Expectation& one, const Meaning& meaning, const Sighting& s);

/// The sighting in the words of the same.
Message describe(const Expectation& one, const Meaning& meaning, const Sighting& s);

/// A printed line as it can be shown, cut where it is long.
std::string shown_line(std::string_view line);

/// A number with that many decimals.
std::string decimal(double value, int decimals);

/// A number without zeros at its end.
std::string plain(double value, int decimals);

} // namespace orb::testing
