#pragma once

#include <string_view>

namespace orb::report {

// page.html, page.css and the modules of page/ as one script, embedded by the build.
extern const std::string_view page_html;
extern const std::string_view page_css;
extern const std::string_view page_js;

} // namespace orb::report
