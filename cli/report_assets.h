#pragma once

#include <string_view>

namespace orb::cli {

// The files of cli/report/, put into the program by the build.
extern const std::string_view report_html;
extern const std::string_view report_css;
extern const std::string_view report_js;

} // namespace orb::cli
