// Requests of an editor about an orbBasic program.

#include "tests/unit/editor/client.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

// Columns below refer to this text.
constexpr auto program = "10 A = 1\n"                          // 0
                         "20 gosub 100\n"                      // 1
                         "30 if A < 9 then goto 20 else end\n" // 2
                         "40 end\n"                            // 3
                         "' blink once\n"                      // 4
                         "100 RGB A,0,0\n"                     // 5
                         "110 A = A + rnd 3\n"                 // 6
                         "120 on A gosub 100,20\n"             // 7
                         "130 return\n";                       // 8

struct Session : LspClient {
  Session() : LspClient("utf-8") { open(program); }
  explicit Session(const std::string& text) : LspClient("utf-8") { open(text); }

  std::vector<std::string> suggested(int line, int character) {
    std::vector<std::string> labels;
    const auto found = at("completion", line, character);
    for (const auto& item : found["items"])
      labels.push_back(item["label"]);
    return labels;
  }
  Json actions(Json range, Json context = Json::object()) {
    return request("textDocument/codeAction", {{"textDocument", {{"uri", uri}}},
                                               {"range", std::move(range)},
                                               {"context", std::move(context)}})["result"];
  }
};

TEST(LspBasicHover, SaysWhatAStatementDoesItsRangesItsVersionAndItsError) {
  Session session("10 goroll 0,100,1\n");
  const auto text = session.hover(0, 5);
  EXPECT_TRUE(has(text, "goroll heading,speed,go")) << text;
  EXPECT_TRUE(has(text, "0 to 359")) << text;
  EXPECT_TRUE(has(text, "orbBasic 1.2")) << text;
  EXPECT_TRUE(has(text, "0Ch Bad numeric parameter")) << text;
  EXPECT_EQ(session.at("hover", 0, 5)["range"], json_range(0, 3, 9));
}

TEST(LspBasicHover, KnowsVariablesFunctionsOperatorsLinesAndJumps) {
  Session session;
  EXPECT_TRUE(has(session.hover(0, 3), "set: in 10, 110")) << session.hover(0, 3);
  EXPECT_TRUE(has(session.hover(0, 3), "read: in 30, 100, 110, 120")) << session.hover(0, 3);
  EXPECT_TRUE(has(session.hover(6, 13), "random number"));
  EXPECT_TRUE(has(session.hover(6, 10), "addition"));
  EXPECT_TRUE(has(session.hover(1, 10), "100 RGB A,0,0"));
  EXPECT_TRUE(has(session.hover(5, 1), "2 jumps lead here"));
  Session other("10 print accelone\n20 goto 99\n30 ? \"RGB\" ' RGB\n");
  EXPECT_TRUE(has(other.hover(0, 12), "accelone"));
  EXPECT_TRUE(has(other.hover(1, 8), "there is no line 99"));
  EXPECT_TRUE(has(other.hover(2, 3), "print"));
  EXPECT_EQ(other.hover(2, 7), "");  // a string
  EXPECT_EQ(other.hover(2, 13), ""); // a comment
}

TEST(LspBasicHover, ExplainsTheRuleOfAnAllowComment) {
  Session session("10 end ' orb: allow unknown-statement\n");
  EXPECT_NE(session.hover(0, 24), "");
}

TEST(LspBasicCompletion, FollowsThePlaceInTheLine) {
  Session session(
      "10 \n20 if A = 1 then \n30 goto \n40 A = ti\n50 on A goto 10,\n60 print \"go\n\n");
  EXPECT_TRUE(session.suggests(0, 3, "goroll"));
  EXPECT_TRUE(session.suggests(0, 3, "if"));
  EXPECT_FALSE(session.suggests(0, 3, "accelX"));
  EXPECT_TRUE(session.suggests(1, 17, "goto"));
  EXPECT_FALSE(session.suggests(1, 17, "if"));
  EXPECT_TRUE(session.suggests(2, 8, "60"));
  EXPECT_FALSE(session.suggests(2, 8, "goroll"));
  EXPECT_TRUE(session.suggests(3, 9, "timerA"));
  EXPECT_TRUE(session.suggests(3, 9, "sqrt"));
  EXPECT_TRUE(session.suggests(4, 16, "40"));
  EXPECT_TRUE(session.suggested(5, 12).empty()); // inside a string
  EXPECT_EQ(session.suggested(6, 0), std::vector<std::string>{"70"});
}

TEST(LspBasicCompletion, ReplacesTheWordThatIsBeingTyped) {
  Session session("10 gor 0,0,0\n");
  const auto completion = session.at("completion", 0, 6);
  for (const auto& item : completion["items"])
    EXPECT_EQ(item["textEdit"]["range"], json_range(0, 3, 6));
}

TEST(LspBasicCompletion, OffersRulesInAnAllowComment) {
  Session session("10 end ' orb: allow \n20 end ' orb\n");
  EXPECT_TRUE(session.suggests(0, 20, "unknown-statement"));
  EXPECT_TRUE(session.suggested(1, 12).empty());
}

TEST(LspBasicNames, DefinitionAndReferencesOfLines) {
  Session session;
  EXPECT_EQ(Session::places(session.at("definition", 1, 10)), "5:0-3");
  EXPECT_EQ(Session::places(session.at("references", 5, 1)), "5:0-3 1:9-12 7:15-18");
  EXPECT_EQ(Session::places(
                session.at("references", 5, 1, {{"context", {{"includeDeclaration", false}}}})),
            "1:9-12 7:15-18");
  EXPECT_EQ(Session::places(session.at("documentHighlight", 2, 23)), "1:0-2 2:22-24 7:19-21");
  EXPECT_EQ(Session::places(session.at("references", 0, 3)), "0:3-4 6:4-5 2:6-7 5:8-9 6:8-9 7:7-8");
  EXPECT_EQ(Session::places(session.at("definition", 4, 5)), "");
}

TEST(LspBasicNames, RenameChangesALineAndItsJumps) {
  Session session;
  EXPECT_EQ(session.at("prepareRename", 1, 10)["placeholder"], "100");
  EXPECT_TRUE(session.at("prepareRename", 4, 3).is_null());
  EXPECT_EQ(session.renamed(1, 10, "200"), "1:9-12 5:0-3 7:15-18");
  EXPECT_EQ(session.renamed(1, 10, "40"), "line 40 already exists");
  EXPECT_EQ(session.renamed(1, 10, "0"), "a line number must be 1 to 65535");
  EXPECT_EQ(session.renamed(1, 10, "65536"), "a line number must be 1 to 65535");
  EXPECT_EQ(session.renamed(1, 10, "ten"), "a line number must be 1 to 65535");
  EXPECT_EQ(session.renamed(3, 4, "x"), "this is neither a line number nor a variable");
}

TEST(LspBasicNames, RenameChangesAVariable) {
  Session session;
  EXPECT_EQ(session.renamed(0, 3, "B"), "0:3-4 2:6-7 5:8-9 6:4-5 6:8-9 7:7-8");
  EXPECT_EQ(session.renamed(0, 3, "Z"), "a variable is one letter from `A` to `Y`");
  Session two("10 A = 1\n20 B = A\n");
  EXPECT_EQ(two.renamed(0, 3, "b"), "`b` is already in use");
}

TEST(LspBasicNames, RenameKnowsTheLineThatSleepWakesAt) {
  Session session("10 sleep 5,0,20\n20 end\n");
  EXPECT_EQ(session.renamed(1, 0, "50"), "0:13-15 1:0-2");
}

TEST(LspBasicOutline, ListsWhereJumpsLead) {
  Session session;
  const auto symbols = session.request("textDocument/documentSymbol",
                                       {{"textDocument", {{"uri", LspClient::uri}}}})["result"];
  ASSERT_EQ(symbols.size(), 2U);
  EXPECT_EQ(symbols[0]["name"], "20");
  EXPECT_EQ(symbols[1]["name"], "100 blink once");
  EXPECT_EQ(symbols[1]["detail"], "subroutine");
  EXPECT_EQ(symbols[1]["range"]["end"]["line"], 8);
}

TEST(LspBasicFormat, GivesTheCanonicalLayoutOnce) {
  Session session("10    end\n");
  const auto edits =
      session.request("textDocument/formatting", {{"textDocument", {{"uri", LspClient::uri}}},
                                                  {"options", {{"tabSize", 2}}}})["result"];
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0]["newText"], "10 end\n");
  Session done("10 end\n");
  EXPECT_TRUE(done.request("textDocument/formatting",
                           {{"textDocument", {{"uri", LspClient::uri}}}})["result"]
                  .empty());
}

TEST(LspBasicActions, OfferTheFixOfAFinding) {
  Session session("10 rgb 255,0,0\n20 delay 10\n30 goto 10\n");
  const auto found = session.actions(json_range(0, 4, 4), {{"only", {"quickfix"}}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]["edit"]["changes"][LspClient::uri][0]["newText"], "RGB");
  EXPECT_TRUE(session.actions(json_range(1, 4, 4), {{"only", {"quickfix"}}}).empty());
}

TEST(LspBasicActions, OfferToRenumber) {
  Session session("5 delay 10\n7 goto 5\n");
  const auto found = session.actions(json_range(0, 0, 0), {{"only", {"source"}}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]["kind"], "source.renumber");
  EXPECT_EQ(found[0]["edit"]["changes"][LspClient::uri][0]["newText"], "10 delay 10\n20 goto 10\n");
}

} // namespace
} // namespace orb::editor
