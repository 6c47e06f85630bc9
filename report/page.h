#pragma once

#include "report/journey.h"

#include <string>
#include <string_view>

namespace orb::report {

/// One self-contained page that plays the run back: no network, no other file. `title` stands on
/// top; the same journey makes the same bytes.
std::string report_page(const Journey& journey, std::string_view title);

} // namespace orb::report
