// Requests of an editor about macro source.

#include "assembler/text/parse_macro.h"
#include "editor/directives.h"
#include "tests/unit/editor/client.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

const std::string macro_uri = "file:///dance.macro";

// Columns below refer to this text.
constexpr auto macro_text = ".const fast = 200\n"               // 0
                            ".macro dance id=40 flags=endsig\n" // 1
                            "  roll fast, 90, delay=200ms\n"    // 2
                            "  stabilization off\n"             // 3
                            "  gosub turn\n"                    // 4
                            "  goto 41 # turn\n"                // 5
                            ".macro turn id=41\n"               // 6
                            "  rotate 90, 500ms\n";             // 7

struct MacroSession : LspClient {
  explicit MacroSession(const std::string& text = macro_text) : LspClient("utf-8") {
    document = macro_uri;
    open(text, document);
  }
};

TEST(LspMacro, FindingsComeFromAssemblerAndLinter) {
  MacroSession session("rol 1, 2\nloop_end\n");
  const auto codes = session.codes();
  EXPECT_NE(std::find(codes.begin(), codes.end(), "macro-unknown-command"), codes.end());
  EXPECT_NE(std::find(codes.begin(), codes.end(), "macro-loop-end"), codes.end());
}

TEST(LspMacro, HoverKnowsCommandsOperandsFlagsNamesAndDirectives) {
  MacroSession session;
  EXPECT_TRUE(has(session.hover(2, 3), "rolls at a speed along a heading"));
  EXPECT_TRUE(has(session.hover(2, 14), "heading")) << session.hover(2, 14);
  EXPECT_TRUE(has(session.hover(2, 14), "0 to 359")) << session.hover(2, 14);
  EXPECT_TRUE(has(session.hover(3, 17), "`off` is 0")) << session.hover(3, 17);
  EXPECT_TRUE(has(session.hover(2, 8), ".const fast = 200"));
  EXPECT_TRUE(has(session.hover(1, 2), "begins a macro"));
  EXPECT_TRUE(has(session.hover(1, 27), "marker 0"));
  EXPECT_EQ(session.hover(5, 14), ""); // a remark
}

TEST(LspMacro, CompletionFollowsThePlaceInTheLine) {
  MacroSession session(
      ".const fast = 200\n.macro dance id=40 \n  \n  roll \n  roll speed=\n"
      "  gosub \n  stabilization \n.macro turn flags=endsig,\n  # ro\n  comment \"ro\n");
  EXPECT_TRUE(session.suggests(2, 2, "roll"));
  EXPECT_TRUE(session.suggests(2, 2, ".macro"));
  EXPECT_TRUE(session.suggests(1, 19, "flags="));
  EXPECT_TRUE(session.suggests(3, 7, "fast"));
  EXPECT_TRUE(session.suggests(3, 7, "heading="));
  EXPECT_FALSE(session.suggests(3, 7, "roll"));
  EXPECT_TRUE(session.suggests(4, 13, "fast"));
  EXPECT_FALSE(session.suggests(4, 13, "heading="));
  EXPECT_TRUE(session.suggests(5, 8, "dance"));
  EXPECT_TRUE(session.suggests(6, 16, "on_without_reset"));
  EXPECT_TRUE(session.suggests(7, 25, "motor_control"));
  EXPECT_FALSE(session.suggests(8, 6, "roll"));
  EXPECT_FALSE(session.suggests(9, 13, "roll"));
}

TEST(LspMacro, NamesLeadToTheirDefinitions) {
  MacroSession session;
  EXPECT_EQ(MacroSession::places(session.ask("definition", 4, 9)), "6:7-11");
  EXPECT_EQ(MacroSession::places(session.ask("definition", 5, 8)), "6:7-11"); // by its id
  EXPECT_EQ(MacroSession::places(session.ask("references", 6, 8)), "6:7-11 4:8-12");
  EXPECT_EQ(MacroSession::places(session.ask("references", 2, 8)), "0:7-11 2:7-11");
}

TEST(LspMacro, RenameChangesANameEverywhere) {
  MacroSession session;
  EXPECT_EQ(session.renamed(4, 9, "spin"), "4:8-12 6:7-11");
  EXPECT_EQ(session.renamed(4, 9, "fast"), "`fast` is already in use");
  EXPECT_EQ(session.renamed(4, 9, "4th"),
            "a name is letters, digits and `_`, and does not begin with a digit");
  EXPECT_EQ(session.renamed(5, 8, "spin"), "there is no macro or constant name here");
}

TEST(LspMacro, OutlineListsTheMacros) {
  MacroSession session;
  const auto symbols = session.request("textDocument/documentSymbol",
                                       {{"textDocument", {{"uri", macro_uri}}}})["result"];
  ASSERT_EQ(symbols.size(), 2U);
  EXPECT_EQ(symbols[0]["name"], "dance");
  EXPECT_EQ(symbols[0]["detail"], "macro 40");
  EXPECT_EQ(symbols[0]["range"]["end"]["line"], 6);
}

TEST(LspMacro, FormattingIndents) {
  MacroSession session(".macro a id=40\nroll 1,2\n");
  const auto edits = session.request("textDocument/formatting",
                                     {{"textDocument", {{"uri", macro_uri}}}})["result"];
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0]["newText"], ".macro a id=40\n  roll 1, 2\n");
}

TEST(LspMacro, DirectivesAreThoseOfTheAssembler) {
  for (const auto& row : macro_directives) {
    const auto text = "." + std::string(row.word) + "\n";
    const auto parsed = assembler::parse(text);
    EXPECT_TRUE(parsed.diagnostics.empty()) << text;
    EXPECT_EQ(parsed.statements.size(), 1U) << text;
  }
}

} // namespace
} // namespace orb::editor
