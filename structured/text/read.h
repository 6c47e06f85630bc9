#pragma once

#include "structured/text/files.h"
#include "structured/text/program.h"

#include <string>
#include <string_view>

namespace orb::structured {

/// Reads a program: the main file, its includes and the macros that it uses. A file that is not
/// text, too large or missing gives one finding. Included paths are relative to `path`.
Program read(std::string name, std::string path, std::string_view text, Files& files);

} // namespace orb::structured
