#pragma once

#include "reference/command_data.h"

#include <string>
#include <vector>

namespace orb::reference {

/// A manual page as a file: `orb-check.1` and its mdoc source.
struct ManualPage {
  std::string file;
  std::string text;
};

/// The complete manual, generated from the command line and the tables: `orb`, a page for each
/// command, `orbbasic` and `orb-macro`.
std::vector<ManualPage> manual(const CommandLine& line);

} // namespace orb::reference
