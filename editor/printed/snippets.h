#pragma once

#include "editor/printed/syntax_files.h"

#include <vector>

namespace orb::editor {

/// Snippets in VS Code's format, one file per language, generated from the tables.
std::vector<SyntaxFile> snippet_files();

} // namespace orb::editor
