// Checks modules and layers (who may include whom: cmake/modules.cmake), and their private names.

#include "repository.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

namespace fs = std::filesystem;

namespace repository {

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && endings.contains(entry.path().extension().string()))
      files.push_back(entry.path());
  return files;
}

namespace {

using Names = std::vector<std::string>;

Names words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// What each module links, in the order of the build files.
struct Build {
  Names modules;
  std::map<std::string, std::set<std::string>> links;
  std::map<std::string, Names> layers;
};

Build read_build() {
  Build build;
  const std::regex row(
      R"((orb_library\(|target_link_libraries\(orb_|set\(links_|set\(layers_)(\w*)([^)]*)\))");
  const std::regex linked(R"(orb::(\w+))");
  const std::sregex_iterator end;
  for (const auto* file : {"cmake/modules.cmake", "CMakeLists.txt", "cli/CMakeLists.txt"}) {
    const auto text = read_all(root / file);
    for (std::sregex_iterator at(text.begin(), text.end(), row); at != end; ++at) {
      const auto kind = (*at)[1].str(), name = (*at)[2].str(), rest = (*at)[3].str();
      if (kind == "set(layers_") {
        build.layers[name] = words_of(rest);
        continue;
      }
      if (kind != "target_link_libraries(orb_")
        build.modules.push_back(name);
      auto& links = build.links[name];
      if (kind == "set(links_") {
        const auto names = words_of(rest);
        links.insert(names.begin(), names.end());
      }
      for (std::sregex_iterator one(rest.begin(), rest.end(), linked); one != end; ++one)
        if ((*one)[1] != "asio") // not ours
          links.insert((*one)[1]);
    }
  }
  return build;
}

const Build& build() {
  static const auto read = read_build();
  return read;
}

} // namespace

const Names& modules() {
  return build().modules;
}

std::set<std::string> reach(const std::string& module) {
  std::set<std::string> names{module};
  for (const auto& name : build().links.at(module))
    names.merge(reach(name));
  return names;
}

namespace {

/// Calls `check` with the folder and the line of each `#include "FOLDER/…"` in a file.
void for_each_include(const fs::path& file,
                      const std::function<void(const fs::path&, const std::string&)>& check) {
  static const std::regex include(R"re(^\s*#\s*include\s+"([a-z_0-9/]+)/[^"/]+")re");
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (std::smatch match; std::regex_search(line, match, include))
      check(match[1].str(), line);
}

TEST(Modules, EveryFolderWithCodeIsOne) {
  const std::set<std::string> others = {"build", "tests", "examples",
                                        "docs"}; // docs: tree-sitter's own headers
  for (const auto& entry : fs::directory_iterator(root)) {
    const auto name = entry.path().filename().string();
    if (!entry.is_directory() || name.starts_with('.') || others.contains(name))
      continue;
    const auto known = std::count(modules().begin(), modules().end(), name);
    EXPECT_TRUE(known == 1 || files_below(entry.path(), {".h", ".cpp"}).empty())
        << name << " is in cmake/modules.cmake " << known << " times";
  }
}

TEST(Modules, IncludeOnlyWhatTheyLink) {
  for (const auto& module : modules()) {
    const auto allowed = reach(module);
    const auto files = code_below(root / module);
    EXPECT_FALSE(files.empty()) << module;
    for (const auto& file : files)
      for_each_include(file, [&](const fs::path& folder, const std::string& line) {
        EXPECT_TRUE(allowed.contains(folder.begin()->string())) << file << ": " << line;
      });
  }
}

TEST(Modules, ALayerIncludesOnlyFromThoseBelowIt) {
  EXPECT_GT(build().layers.size(), 5U);
  for (const auto& [module, layers] : build().layers) {
    const auto height = [&, &module = module, &layers = layers](const fs::path& folder) {
      const auto found = std::find(layers.begin(), layers.end(), folder.begin()->string());
      EXPECT_NE(found, layers.end()) << module << " has no layer " << folder;
      return found - layers.begin();
    };
    for (const auto& file : code_below(root / module)) {
      const auto own = height(fs::relative(file.parent_path(), root / module));
      for_each_include(file, [&, &module = module](const fs::path& folder, const auto& line) {
        if (*folder.begin() == module) {
          EXPECT_LE(height(folder.lexically_relative(module)), own) << file << ": " << line;
        }
      });
    }
  }
}

TEST(Modules, AFolderCanBeSeenAtAGlance) {
  constexpr std::ptrdiff_t most_files = 31;
  for (const auto& module : modules())
    for (fs::recursive_directory_iterator entry(root / module), end; entry != end; ++entry)
      if (entry->path().filename() == "node_modules") {
        entry.disable_recursion_pending(); // npm's, not ours
      } else if (entry->is_directory()) {
        EXPECT_LE(std::distance(fs::directory_iterator(entry->path()), {}), most_files)
            << entry->path() << " needs layers";
      }
}

/// Returns the names in backticks, in order.
Names in_backticks(const std::string& text) {
  static const std::regex name("`([a-z.]+)/?`");
  Names names;
  for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at)
    names.push_back((*at)[1]);
  return names;
}

TEST(Modules, TheMapHasEachWithItsLayers) {
  std::set<std::string> listed;
  std::map<std::string, Names> layers;
  std::istringstream page(read_all(root / "docs" / "architecture.md"));
  const std::regex module(R"(^\| \d+ \| `(\w+)/` \|)"), layered(R"(^\| `(\w+)/` \| (.*) \|$)");
  for (std::string line; std::getline(page, line);)
    if (std::smatch match; std::regex_search(line, match, module))
      listed.insert(match[1]);
    else if (std::regex_search(line, match, layered) && build().layers.contains(match[1]))
      layers.emplace(match[1], in_backticks(match[2]));
  EXPECT_EQ(listed, std::set<std::string>(modules().begin(), modules().end()));
  for (const auto& [name, expected] : build().layers) {
    std::erase_if(layers[name], [&, &all = expected](const std::string& word) {
      return std::find(all.begin(), all.end(), word) == all.end();
    });
    EXPECT_EQ(layers[name], expected) << name << " in docs/architecture.md";
  }
}

TEST(Modules, ClangTidySeesTheHeadersOfEach) {
  const auto text = read_all(root / ".clang-tidy");
  for (const auto& module : modules())
    if (module != "python") { // has no headers
      EXPECT_TRUE(std::regex_search(text, std::regex("[(|]" + module + "[)|]"))) << module;
    }
}

/// Returns the folders that cmake/orb.cmake joins by themselves: their private names may equal
/// others of their module.
Names apart() {
  const auto text = read_all(root / "cmake" / "orb.cmake");
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(R"(set\(ORB_APART ([^)]*)\))")));
  return words_of(match[1]);
}

/// Returns the names that a file declares in anonymous namespaces, each with its meaning: the file,
/// or the line of an alias. Namespace aliases do not count.
std::map<std::string, std::string> private_names(const fs::path& file) {
  static const std::regex alias(R"(^using (\w+) =)");
  static const std::regex type(R"(^(?:struct|class|enum class|enum) (\w+)(;| \{| : ))");
  static const std::regex value(
      R"(^(?:constexpr|const|static|inline|std::)[^=({]*[&* ](\w+)(?:\[\w*\])? ?[={])");
  static const std::regex function(R"(^(?!return|throw)\w[\w:<>,&*\[\] ]*[&* ](\w+)\()");
  std::map<std::string, std::string> names;
  std::ifstream stream(file);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (line == "namespace {")
      inside = true;
    else if (line == "} // namespace")
      inside = false;
    else if (inside && std::regex_search(line, match, alias))
      names.emplace(match[1], line);
    else if (inside &&
             (std::regex_search(line, match, type) || std::regex_search(line, match, value) ||
              std::regex_search(line, match, function)))
      names.emplace(match[1], file.lexically_relative(root).string());
  }
  return names;
}

/// A name with two meanings in a module is hard to find. It does not compile when the files are
/// joined, but not every build joins them.
TEST(Modules, APrivateNameMeansOneThing) {
  const auto folders = apart();
  for (const auto& module : modules()) {
    std::map<std::pair<std::string, std::string>, std::set<std::string>> places;
    for (const auto& file : files_below(root / module, {".cpp"})) {
      if (file.stem().string().ends_with("_windows"))
        continue; // replaces the file without this ending
      const auto path = file.lexically_relative(root).generic_string();
      std::string group = module;
      for (const auto& folder : folders)
        if (path.starts_with(folder + "/"))
          group = folder;
      for (const auto& [name, meaning] : private_names(file))
        places[{group, name}].insert(meaning);
    }
    for (const auto& [name, files] : places)
      EXPECT_EQ(files.size(), 1U) << "`" << name.second << "` is private in "
                                  << testing::PrintToString(files);
  }
}

} // namespace
} // namespace repository
