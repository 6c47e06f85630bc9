#pragma once

#include "structured/text/program.h"

#include <string>
#include <string_view>

namespace orb::structured {

/// Appends a file to a program: its text, its statements and the findings about lines that do not
/// parse and blocks that do not close. Total: any bytes will do. `text` is at most
/// spec::Limit::SourceBytes long.
void parse(Program& program, std::string name, std::string path, std::string_view text);

} // namespace orb::structured
