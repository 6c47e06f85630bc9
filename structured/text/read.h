#pragma once

#include "structured/text/files.h"
#include "structured/text/program.h"

#include <string>
#include <string_view>

namespace orb::structured {

/// Reads a program: the main file, what it includes and the macros that it uses. A file that is no
/// text, too large or missing is one finding. `path` is what includes count from.
Program read(std::string name, std::string path, std::string_view text, Files& files);

} // namespace orb::structured
