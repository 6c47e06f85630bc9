#pragma once

#include "editor/printed/syntax_files.h"

#include <vector>

namespace orb::editor {

/// The tree-sitter grammars of programs and macros with highlighting queries, generated from the
/// tables. `./dev grammars` runs `tree-sitter generate`, whose output is next to each grammar.
std::vector<SyntaxFile> tree_sitter_files();

} // namespace orb::editor
