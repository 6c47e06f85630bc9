#pragma once

#include "editor/printed/syntax_files.h"

#include <vector>

namespace orb::editor {

/// Snippets for VS Code and for whatever reads its form, a file a language, printed from the
/// tables.
std::vector<SyntaxFile> snippet_files();

} // namespace orb::editor
