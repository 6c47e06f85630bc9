#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::cli {

/// A file below docs/editors that lists words of the robot.
struct EditorFile {
  std::string path;
  std::string text;
};

/// The grammars for VS Code and the syntax files for Vim, printed from the tables.
std::vector<EditorFile> editor_files();

} // namespace orb::cli
