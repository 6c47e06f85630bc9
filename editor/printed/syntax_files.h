#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// A file below docs/editors with words of the robot.
struct SyntaxFile {
  std::string path;
  std::string text;
};

/// The grammars for VS Code and the syntax files for Vim, generated from the tables.
std::vector<SyntaxFile> syntax_files();

} // namespace orb::editor
