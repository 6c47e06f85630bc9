#pragma once

#include "structured/text/program.h"

#include <string>
#include <string_view>

namespace orb::structured {

/// Appends a file to a program: its text, its statements, and findings about lines that do not
/// parse and blocks that are not closed. Accepts any bytes. `text` must be at most
/// spec::Limit::SourceBytes long.
void parse(Program& program, std::string name, std::string path, std::string_view text);

} // namespace orb::structured
