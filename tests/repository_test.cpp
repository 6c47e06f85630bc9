// Checks rules that hold for the whole repository.

#include "repository.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;

namespace {

using namespace repository;

/// The playground's compiler has the oldest standard library of all.
TEST(Includes, WhatThePlaygroundIsBuiltOfUsesNothingThatItsLibraryLacks) {
  const std::regex lacking(R"(std::(ranges::\w+\(|bit_cast<))");
  const std::set<std::string> elsewhere = {"bluez.cpp", "native",
                                           "tether"}; // not part of the playground
  for (const auto& name : reach("playground"))
    for (const auto& file : files_below(root / name, {".h", ".cpp"}))
      if (!elsewhere.contains(file.parent_path().filename().string()) &&
          !elsewhere.contains(file.filename().string())) {
        const auto text = read_all(file);
        EXPECT_FALSE(std::regex_search(text, lacking))
            << file << " has `std::ranges` or `bit_cast`";
      }
}

/// Returns a line of C++ without its literals and comment.
struct Line {
  std::string code;
  bool commented = false;
};

Line split(const std::string& text) {
  static const std::regex quoted(R"re("(\\.|[^"\\])*"|'(\\.|[^'\\])')re");
  auto code = std::regex_replace(text, quoted, "_");
  const auto comment = code.find("//");
  return {code.substr(0, comment), comment != std::string::npos};
}

TEST(Numbers, OfTheRobotAreRowsAndOthersSayWhatTheyAre) {
  const std::regex number(R"((^|[^\w.'])(0[xX][0-9A-Fa-f']+|\d[\d']{2,})(?![\w.']))");
  std::size_t seen = 0;
  for (const auto* module : {"vm", "protocol", "uploader", "compiler", "assembler", "serve"})
    for (const auto& file : files_below(root / module, {".h", ".cpp"})) {
      std::ifstream stream(file);
      bool explained = false; // a comment on the line above explains it
      int at = 0;
      for (std::string text; std::getline(stream, text);) {
        ++at;
        const auto [code, commented] = split(text);
        const bool blank = code.find_first_not_of(' ') == std::string::npos;
        const bool has_number = std::regex_search(code, number);
        seen += has_number ? 1 : 0;
        EXPECT_TRUE(!has_number || commented || explained)
            << file << ":" << at << ": " << text
            << "\n  a fact about the robot is a row of spec/; any other number has a comment";
        explained = blank && commented;
      }
    }
  EXPECT_GT(seen, 10U);
}

/// Fails for each file that includes one of `headers` outside the modules where that is allowed.
void expect_only(const std::set<std::string>& allowed, const std::vector<std::string>& headers) {
  for (const auto& module : modules()) {
    if (allowed.contains(module))
      continue;
    for (const auto& file : files_below(root / module, {".h", ".cpp"})) {
      const auto text = read_all(file);
      for (const auto& header : headers)
        EXPECT_EQ(text.find("#include " + header), std::string::npos) << file << ": " << header;
    }
  }
}

TEST(Includes, OnlyParsersSeePegtl) {
  expect_only({"base", "compiler", "assembler", "structured"}, {"<tao/pegtl"});
  expect_only({"compiler", "assembler", "structured"},
              {"\"base/peg.h"}); // the only one that includes it
}

/// CLI11 takes three seconds to compile.
TEST(Includes, OnlyTheModelOfOptionsSeesCli11) {
  for (const auto& file : files_below(root / "cli", {".h", ".cpp"}))
    if (file.parent_path().filename() != "model") {
      EXPECT_EQ(read_all(file).find("#include <CLI/"), std::string::npos) << file;
    }
}

TEST(Includes, OnlyCoursesSeeXml) {
  expect_only({"report"}, {"<pugixml"});
}

TEST(Includes, OnlyBluezSeesDBus) {
  expect_only({"uploader", "serve"}, {"<sdbus-c++"});
  for (const auto* module : {"uploader", "serve"})
    for (const auto& file : files_below(root / module, {".h", ".cpp"}))
      if (file.filename().string().find("bluez") == std::string::npos) {
        EXPECT_EQ(read_all(file).find("<sdbus-c++"), std::string::npos) << file;
      }
}

// The browser links everything except the parts that need an operating system.
TEST(Includes, OnlyTheEdgeSeesFilesSocketsAndTheConsole) {
  expect_only({"cli", "serve", "disk", "uploader"},
              {"<CLI/", "<asio", "<fstream", "<filesystem", "<iostream", "<cstdio", "<unistd.h",
               "<fcntl.h", "<sys/", "<csignal", "<termios.h"});
}

TEST(Golden, EveryExampleIsCheckedAndRun) {
  std::string transcripts;
  for (const auto& file : files_below(root / "tests" / "golden" / "examples", {".txt"}))
    transcripts += read_all(file);
  std::size_t count = 0;
  for (const auto& path : files_below(root / "examples", {".bas", ".orb", ".macro", ".svg"})) {
    const auto name = fs::relative(path, root).generic_string();
    if (name.starts_with("examples/demo/") || name.starts_with("examples/lessons/"))
      continue;
    ++count;
    const std::regex checked("orb check [^\n]*" + name);
    const std::regex run("orb run [^\n]*" + name);
    EXPECT_TRUE(std::regex_search(transcripts, checked)) << name;
    EXPECT_TRUE(std::regex_search(transcripts, run)) << name;
  }
  EXPECT_GE(count, 20U);
}

TEST(Golden, EveryLessonHasATaskAStarterATestAndASolution) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(root / "examples" / "lessons")) {
    if (!entry.is_directory())
      continue;
    ++count;
    for (const auto* name : {"README.md", "robot.orb", "robot.test", "solution.orb"})
      EXPECT_TRUE(fs::exists(entry.path() / name)) << entry.path() << ": " << name;
    // The transcript must show that the starter fails and the solution passes.
    const auto lesson = entry.path().filename().string();
    const auto shown = read_all(root / "tests" / "golden" / "lessons" / (lesson + ".txt"));
    const auto solved = shown.find("--program solution.orb");
    ASSERT_NE(solved, std::string::npos) << lesson;
    EXPECT_NE(shown.substr(0, solved).find("[exit 1]"), std::string::npos) << lesson;
    const std::regex all(R"((\d+) of \1 tests passed)");
    EXPECT_TRUE(std::regex_search(shown.substr(solved), all)) << lesson;
    EXPECT_EQ(shown.find("FAIL", solved), std::string::npos) << lesson;
  }
  EXPECT_EQ(count, 10U);
}

TEST(Golden, EveryRuleIsShown) {
  std::string shown;
  for (const auto& file : files_below(root / "tests" / "golden", {".txt"}))
    shown += read_all(file);
  const std::regex row(R"re(ORB_RULE\(\w+,\s*"([a-z-]+)")re");
  for (const auto* table :
       {"compiler/text/rules.def", "structured/text/rules.def", "assembler/text/rules.def",
        "report/rules.def", "testing/text/rules.def", "protocol/judge/rules.def"}) {
    const auto text = read_all(root / table);
    const std::sregex_iterator end;
    std::size_t rows = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), row); at != end; ++at, ++rows)
      EXPECT_NE(shown.find("[" + (*at)[1].str() + "]"), std::string::npos)
          << (*at)[1] << " of " << table << " occurs in no transcript";
    EXPECT_GT(rows, 10U) << table;
  }
}

/// Returns the English texts of all ORB_TEXT rows, by file and name.
std::map<std::string, std::string> all_texts() {
  std::map<std::string, std::string> texts;
  const std::regex row(R"re(ORB_TEXT\((\w+),\s*"((?:[^"\\]|\\.)*)")re");
  const std::regex quoted(R"re(\\(["\\]))re");
  std::vector<fs::path> files;
  for (const auto& module : modules())
    for (auto& file : files_below(root / module, {".def"}))
      files.push_back(std::move(file));
  for (const auto& file : files) {
    const auto text = read_all(file);
    for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at)
      texts[file.lexically_relative(root).string() + ": " + (*at)[1].str()] =
          std::regex_replace((*at)[2].str(), quoted, "$1");
  }
  return texts;
}

/// True if a line contains the parts of a text between its holes, in order.
bool says(std::string_view line, std::string_view text) {
  std::size_t from = 0;
  while (true) {
    const auto open = text.find('{');
    const auto at = line.find(text.substr(0, open), from);
    if (at == std::string_view::npos || open == std::string_view::npos)
      return at != std::string_view::npos;
    from = at + open;
    text.remove_prefix(text.find('}') + 1);
  }
}

// A text that no transcript shows may be wrong, or unreachable.
TEST(Golden, EveryTextIsShown) {
  std::vector<std::string> lines;
  for (const auto& file : files_below(root / "tests" / "golden", {".txt"})) {
    std::istringstream text(read_all(file));
    for (std::string line; std::getline(text, line);)
      lines.push_back(std::move(line));
  }
  const auto texts = all_texts();
  EXPECT_GT(texts.size(), 400U);
  for (const auto& [name, text] : texts) {
    const auto says_it = [&said = text](const auto& line) { return says(line, said); };
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), says_it))
        << name << " occurs in no transcript: " << text;
  }
}

TEST(Golden, EveryTextIsDeclaredOnce) {
  std::map<std::string, std::string> first;
  for (const auto& [name, text] : all_texts())
    EXPECT_TRUE(first.emplace(text, name).second)
        << name << " says what " << first[text] << " says";
}

TEST(Translations, EachIsOfATextThatIsSaid) {
  std::set<std::string> known;
  for (const auto& [name, text] : all_texts())
    known.insert(text);
  const auto german = nlohmann::json::parse(read_all(root / "translations" / "de.json"));
  for (const auto* section : {"findings", "verdicts"})
    for (const auto& [english, translation] : german.at(section).items())
      EXPECT_TRUE(known.contains(english)) << "no row says: " << english;
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
  EXPECT_EQ(named.size(), 1 + 2 * package["contributes"]["languages"].size());
  for (const auto& path : named)
    EXPECT_TRUE(fs::exists(path)) << path;
}

TEST(Docs, ArchitectureNamesFilesThatExist) {
  const auto text = read_all(root / "docs" / "architecture.md");
  const std::regex path(R"(`([a-z_]+/[a-z_0-9/]+\.(?:cpp|h|def|js))`)");
  const std::sregex_iterator end;
  std::size_t count = 0;
  for (std::sregex_iterator at(text.begin(), text.end(), path); at != end; ++at, ++count)
    EXPECT_TRUE(fs::exists(root / (*at)[1].str())) << (*at)[1];
  EXPECT_GT(count, 25U);
}

TEST(Docs, LibraryLinksToTheExamplesAndNamesTheHeaders) {
  const auto page = read_all(root / "docs" / "using" / "library.md");
  std::set<std::string> programs;
  for (const auto& file : files_below(root / "examples" / "library", {".cpp"})) {
    programs.insert(read_all(file));
    EXPECT_NE(page.find("../../examples/library/" + file.filename().string()), std::string::npos)
        << "docs/using/library.md should link to " << file;
  }
  const std::string fence = "```cpp\n";
  std::size_t shown = 0;
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at), ++shown) {
    at += fence.size();
    const auto text = page.substr(at, page.find("```", at) - at);
    EXPECT_EQ(programs.count(text), 1U) << "no program of examples/library:\n" << text;
  }
  EXPECT_GT(shown, 0U);
  const auto package = read_all(root / "cmake" / "library.cmake");
  const auto begin = package.find("set(library_headers");
  const auto list = package.substr(begin, package.find(')', begin) - begin);
  const std::regex header(R"([a-z]+/[a-z_/]+\.h)");
  for (std::sregex_iterator at(list.begin(), list.end(), header), end; at != end; ++at)
    EXPECT_NE(page.find("`orb/" + at->str() + "`"), std::string::npos) << at->str();
}

} // namespace
