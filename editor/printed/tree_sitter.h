#pragma once

#include "editor/printed/syntax_files.h"

#include <vector>

namespace orb::editor {

/// The tree-sitter grammars of programs and macros with their highlighting queries, printed from
/// the tables. What `tree-sitter generate` makes of a grammar lies beside it: `./dev grammars`.
std::vector<SyntaxFile> tree_sitter_files();

} // namespace orb::editor
