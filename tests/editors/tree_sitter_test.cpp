// The committed tree-sitter parsers must parse every program that orb accepts without an error.

#include "assembler/lint/lint.h"
#include "compiler/check.h"
#include "compiler/text/parse_basic.h"
#include "structured/compile.h"
#include "structured/lift/lift.h"
#include "tests/golden/files.h"
#include "tests/random_program.h"
#include "tests/unit/structured/random_structured.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>
#include <tree_sitter/api.h>

extern "C" {
const TSLanguage* tree_sitter_orbbasic();
const TSLanguage* tree_sitter_orbstructured();
const TSLanguage* tree_sitter_orbmacro();
}

namespace orb {
namespace {

namespace fs = std::filesystem;
const fs::path root = ORB_ROOT;

const TSLanguage* language_of(const std::string& name) {
  if (name.ends_with(".bas"))
    return tree_sitter_orbbasic();
  if (name.ends_with(".orb"))
    return tree_sitter_orbstructured();
  return name.ends_with(".macro") ? tree_sitter_orbmacro() : nullptr;
}

/// Returns the tree of a text as text if it contains an error; otherwise nothing.
std::string error_in(const std::string& name, const std::string& text) {
  const std::unique_ptr<TSParser, decltype(&ts_parser_delete)> parser(ts_parser_new(),
                                                                      &ts_parser_delete);
  if (!ts_parser_set_language(parser.get(), language_of(name)))
    return "the library is too old or too new for the parser";
  const std::unique_ptr<TSTree, decltype(&ts_tree_delete)> tree(
      ts_parser_parse_string(parser.get(), nullptr, text.data(),
                             static_cast<std::uint32_t>(text.size())),
      &ts_tree_delete);
  const auto top = ts_tree_root_node(tree.get());
  if (!ts_node_has_error(top))
    return {};
  const std::unique_ptr<char, decltype(&std::free)> words(ts_node_string(top), &std::free);
  return words.get();
}

/// Files that can include each other: those of a folder or of a transcript.
class Neighbours final : public structured::Files {
public:
  std::map<std::string, std::string> texts;

  std::optional<std::string> read(const std::string& path) override {
    const auto found = texts.find(path);
    return found == texts.end() ? std::nullopt : std::optional(found->second);
  }
};

bool is_accepted(const std::string& name, const std::string& text, Neighbours& files) {
  if (name.ends_with(".bas"))
    return compiler::parse(text).faults.empty(); // wrong values are no errors of the grammar
  if (name.ends_with(".orb"))
    return !structured::compile(name, name, text, {}, files).has_errors();
  return !any_error(assembler::check(Source(name, text)));
}

/// Checks all of them; returns how many orb accepts.
std::size_t expect_no_errors(Neighbours& files, const std::string& where) {
  std::size_t accepted = 0;
  for (const auto& [name, text] : files.texts) {
    if (language_of(name) == nullptr || text.find('\0') != std::string::npos ||
        !is_accepted(name, text, files))
      continue;
    ++accepted;
    EXPECT_EQ(error_in(name, text), "") << where << ": " << name << "\n" << text;
  }
  return accepted;
}

TEST(TreeSitter, ExamplesAndLessons) {
  std::map<fs::path, Neighbours> folders;
  for (const auto& entry : fs::recursive_directory_iterator(root / "examples"))
    if (entry.is_regular_file() && language_of(entry.path().string()) != nullptr)
      folders[entry.path().parent_path()].texts[entry.path().filename()] =
          files::read(entry.path());
  std::size_t accepted = 0;
  for (auto& [folder, neighbours] : folders)
    accepted += expect_no_errors(neighbours, folder.string());
  EXPECT_GT(accepted, 70U);
}

TEST(TreeSitter, ProgramsOfTheTranscripts) {
  std::size_t accepted = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "tests" / "golden")) {
    if (entry.path().extension() != ".txt")
      continue;
    Neighbours neighbours;
    std::string* text = nullptr;
    for (const auto& line : files::lines(files::read(entry.path()))) {
      if (line.starts_with("=== "))
        text = &neighbours.texts[line.substr(4, line.find(' ', 4) - 4)];
      else if (text != nullptr)
        *text += line + "\n";
    }
    accepted += expect_no_errors(neighbours, entry.path().string());
  }
  EXPECT_GT(accepted, 300U);
}

TEST(TreeSitter, ProgramsAtRandom) {
  Neighbours files;
  std::size_t accepted = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    files.texts["a.bas"] = testing::RandomProgram(seed, {}).write();
    files.texts["b.orb"] = testing::RandomStructured(seed).write();
    if (const auto lifted = structured::lift(compiler::check(files.texts["a.bas"], {}));
        !lifted.text.empty())
      files.texts["c.orb"] = lifted.text;
    accepted += expect_no_errors(files, "seed " + std::to_string(seed));
    if (HasFailure())
      return;
  }
  EXPECT_GT(accepted, 200U);
}

TEST(TreeSitter, WhatIsNoProgramHasErrors) {
  for (const auto* line : {"10 forX = 1 to 3\n", "10 printA\n", "goroll 1,2,3\n", "10 goto A\n",
                           "10 if A = 1 then if B = 1 then end\n", "10 A = (1\n"})
    EXPECT_NE(error_in("a.bas", line), "") << line;
  for (const auto* text : {"if x then\nprint 1\n", "end sub\n", "print 1 +\n", "x = (1\n",
                           "sub a\nend function\n", "if a then if b then c\n", "a = 1 b = 2\n"})
    EXPECT_NE(error_in("a.orb", text), "") << text;
  for (const auto* line : {"roll speed=\n", "= 3\n", "comment \"a\n"})
    EXPECT_NE(error_in("a.macro", line), "") << line;
}

TEST(TreeSitter, AnyBytesAreRead) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random{seed};
    auto text = testing::RandomStructured(seed).write();
    for (int i = 0; i < 9; ++i)
      text[random.below(text.size())] = static_cast<char>(random.below(256));
    for (const auto* name : {"a.bas", "a.orb", "a.macro"})
      error_in(name, text);
  }
}

TEST(TreeSitter, QueriesCompile) {
  for (const auto* name : {"orbbasic", "orbstructured", "orbmacro"}) {
    const auto text = files::read(root / "docs" / "editors" / "tree-sitter" / name / "queries" /
                                  "highlights.scm");
    std::uint32_t offset = 0;
    auto error = TSQueryErrorNone;
    const auto ending = std::string(name) == "orbbasic"   ? "a.bas"
                        : std::string(name) == "orbmacro" ? "a.macro"
                                                          : "a.orb";
    const std::unique_ptr<TSQuery, decltype(&ts_query_delete)> query(
        ts_query_new(language_of(ending), text.data(), static_cast<std::uint32_t>(text.size()),
                     &offset, &error),
        &ts_query_delete);
    EXPECT_EQ(error, TSQueryErrorNone)
        << name << " at byte " << offset << ": " << text.substr(offset, 40);
  }
}

} // namespace
} // namespace orb
