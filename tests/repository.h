#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

/// Reads the repository itself, for tests of rules that hold everywhere in it.
namespace repository {

inline const std::filesystem::path root = ORB_ROOT;

/// Returns the bytes of a file; empty if it cannot be read.
std::string read_all(const std::filesystem::path& path);

/// Returns all files below `folder` with one of these endings, such as `.cpp`.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                               const std::set<std::string>& endings);

/// Returns the C++ files below `folder`.
inline std::vector<std::filesystem::path> code_below(const std::filesystem::path& folder) {
  return files_below(folder, {".h", ".cpp", ".def", ".inc"});
}

/// Returns the names of the modules, as listed in cmake/modules.cmake and CMakeLists.txt.
const std::vector<std::string>& modules();

/// Returns the modules from which a file of `module` may include: its own and all that it links,
/// directly or not.
std::set<std::string> reach(const std::string& module);

} // namespace repository
