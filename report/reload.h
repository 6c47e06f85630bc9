#pragma once

#include <string>

namespace orb::report {

/// A page of report_page() that loads itself again when its file holds another page: it looks at
/// the file every second, also where it was opened from a folder and not from a server.
std::string reloading(std::string page);

} // namespace orb::report
