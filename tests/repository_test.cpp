// What holds for the repository as a whole, read from its files.

#include "spec/macro.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = ORB_ROOT;

/// Who may include whom (docs/architecture.md): the folders that each folder may name.
const std::map<std::string, std::set<std::string>> floors = {
    {"base", {"base"}},
    {"spec", {"spec"}},
    {"protocol", {"protocol", "spec", "base"}},
    {"bytecode", {"bytecode", "spec", "base"}},
    {"compiler", {"compiler", "bytecode", "spec", "base"}},
    {"assembler", {"assembler", "protocol", "spec", "base"}},
    {"vm", {"vm", "protocol", "bytecode", "spec", "base"}},
    {"uploader", {"uploader", "protocol", "spec", "base"}},
    {"cli",
     {"cli", "uploader", "vm", "assembler", "compiler", "bytecode", "protocol", "spec", "base"}},
};

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

TEST(Floors, EachFolderIncludesOnlyFromLowerOnes) {
  const std::regex include(R"(^\s*#\s*include\s+"([a-z_0-9]+)/[^"]+")");
  for (const auto& [folder, allowed] : floors) {
    const auto files = files_below(root / folder, {".h", ".cpp", ".def"});
    EXPECT_FALSE(files.empty()) << folder;
    for (const auto& file : files) {
      std::ifstream stream(file);
      for (std::string line; std::getline(stream, line);) {
        std::smatch match;
        if (std::regex_search(line, match, include)) {
          EXPECT_TRUE(allowed.contains(match[1])) << file << ": " << line;
        }
      }
    }
  }
}

TEST(Floors, OnlyParsersSeePegtl) {
  for (const auto& [folder, allowed] : floors)
    for (const auto& file : files_below(root / folder, {".h", ".cpp"}))
      if (read_all(file).find("tao/pegtl") != std::string::npos) {
        EXPECT_TRUE(folder == "compiler" || folder == "assembler") << file;
      }
}

TEST(Golden, EveryExampleIsCheckedAndRun) {
  std::string transcripts;
  for (const auto& file : files_below(root / "tests" / "golden" / "examples", {".txt"}))
    transcripts += read_all(file);
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(root / "examples")) {
    const auto name = "examples/" + entry.path().filename().string();
    if (!name.ends_with(".bas") && !name.ends_with(".macro"))
      continue;
    ++count;
    const std::regex checked("orb check [^\n]*" + name);
    const std::regex run("orb run [^\n]*" + name);
    EXPECT_TRUE(std::regex_search(transcripts, checked)) << name;
    EXPECT_TRUE(std::regex_search(transcripts, run)) << name;
  }
  EXPECT_GE(count, 20U);
}

TEST(Golden, EveryRuleIsShown) {
  std::string shown;
  for (const auto& file : files_below(root / "tests" / "golden", {".txt"}))
    shown += read_all(file);
  const std::regex row(R"re(ORB_RULE\(\w+,\s*"([a-z-]+)")re");
  for (const auto* table : {"compiler/rules.def", "assembler/rules.def"}) {
    const auto text = read_all(root / table);
    const std::sregex_iterator end;
    std::size_t rows = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), row); at != end; ++at, ++rows)
      EXPECT_NE(shown.find("[" + (*at)[1].str() + "]"), std::string::npos)
          << (*at)[1] << " of " << table << " occurs in no transcript";
    EXPECT_GT(rows, 10U) << table;
  }
}

TEST(Golden, EveryTranscriptSaysWhatItShows) {
  for (const auto& file : files_below(root / "tests" / "golden", {".txt"})) {
    const auto text = read_all(file);
    EXPECT_TRUE(text.starts_with("# ")) << file << " begins with a `#` sentence";
    EXPECT_NE(text.find("\n$ "), std::string::npos) << file;
  }
}

TEST(Editors, TheVsCodeExtensionNamesFilesThatExistAndParse) {
  const auto folder = root / "docs" / "editors" / "vscode";
  const auto parse = [](const fs::path& path) {
    return nlohmann::json::parse(read_all(path), nullptr, false);
  };
  for (const auto& file : files_below(folder, {".json"}))
    EXPECT_FALSE(parse(file).is_discarded()) << file;
  const auto package = parse(folder / "package.json");
  std::set<fs::path> named{folder / package["main"]};
  for (const auto& language : package["contributes"]["languages"])
    named.insert(folder / language["configuration"]);
  for (const auto& grammar : package["contributes"]["grammars"]) {
    const auto path = folder / grammar["path"];
    named.insert(path);
    EXPECT_EQ(parse(path)["scopeName"], grammar["scopeName"]) << path;
  }
  EXPECT_EQ(named.size(), 5U);
  for (const auto& path : named)
    EXPECT_TRUE(fs::exists(path)) << path;
}

/// The bytes of a command as its table in docs/macros.md shows them: `05 speed heading:2
/// [delay]`.
std::string command_row(const orb::spec::MacroCommandInfo& info) {
  using orb::spec::MacroOperandKind;
  using orb::spec::MacroUnit;
  auto bytes = fmt::format("{:02X}", info.code);
  std::string operands;
  for (const auto& operand : info) {
    const bool text = operand.kind == MacroOperandKind::Text;
    bytes += text                 ? " length:2 text"
             : operand.width == 2 ? fmt::format(" {}:2", operand.name)
                                  : fmt::format(" {}", operand.name);
    const auto* unit = operand.unit == MacroUnit::Milliseconds ? " ms"
                       : operand.unit == MacroUnit::Ticks10ms  ? " x 10 ms"
                       : operand.unit == MacroUnit::Degrees    ? " deg"
                                                               : "";
    const auto name = operand.kind == MacroOperandKind::Delay ? fmt::format("[{}]", operand.name)
                                                              : std::string(operand.name);
    operands += fmt::format(
        "{}{} {}", operands.empty() ? "" : ", ", name,
        text ? "\"...\"" : fmt::format("{} to {}{}", operand.minimum, operand.maximum, unit));
  }
  return fmt::format("| `{}` | `{}` | {} | {} | {} |\n", info.mnemonic, bytes, operands,
                     info.executive, info.summary);
}

TEST(Docs, MacrosHasTheTableOfCommands) {
  std::string table = "| command | bytes | operands | executive | |\n|---|---|---|---|---|\n";
  for (const auto& info : orb::spec::macro_commands)
    table += command_row(info);
  EXPECT_NE(read_all(root / "docs" / "macros.md").find(table), std::string::npos)
      << "docs/macros.md should hold:\n"
      << table;
}

TEST(Docs, MacrosHasTheTableOfFlags) {
  std::string table = "| word | bit | documented as | |\n|---|---|---|---|\n";
  for (const auto& info : orb::spec::macro_flags)
    table +=
        fmt::format("| `{}` | {:02X} | {} | {} |\n", info.word, info.bit, info.name, info.summary);
  EXPECT_NE(read_all(root / "docs" / "macros.md").find(table), std::string::npos)
      << "docs/macros.md should hold:\n"
      << table;
}

} // namespace
