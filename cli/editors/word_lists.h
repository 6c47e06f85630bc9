#pragma once

#include "cli/context/context.h"

#include <string>

namespace orb::cli {

/// Writes the grammars and syntax files of all editors into `folder`, with their paths below
/// docs/editors.
void write_editor_files(Context& context, const std::string& folder);

} // namespace orb::cli
