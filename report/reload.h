#pragma once

#include <string>

namespace orb::report {

/// Makes a page of report_page() reload itself when its file changes: it checks every second, even
/// if opened from a folder and not from a server.
std::string reloading(std::string page);

} // namespace orb::report
