// Requests of an editor about a structured program.

#include "tests/unit/editor/client.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

// Columns below refer to this text.
constexpr auto structured_text = "const side = 1.5s\n"             // 0
                                 "array visits[4]\n"               // 1
                                 "' drives one side\n"             // 2
                                 "sub leg(n)\n"                    // 3
                                 "  goroll n * 90, 80, 1\n"        // 4
                                 "  delay side\n"                  // 5
                                 "  visits[n] += 1\n"              // 6
                                 "end sub\n"                       // 7
                                 "function twice(x)\n"             // 8
                                 "  return x * 2\n"                // 9
                                 "end function\n"                  // 10
                                 "turns = rnd(3)\n"                // 11
                                 "for n = 1 to turns\n"            // 12
                                 "  leg(n)\n"                      // 13
                                 "  leg(twice(n) - 1)\n"           // 14
                                 "next n\n"                        // 15
                                 "again:\n"                        // 16
                                 "delay side\n"                    // 17
                                 "print visits[1]\n"               // 18
                                 "if turns > 1 then goto again\n"; // 19

const std::string name = "file:///robot/patrol.orb";

struct StructuredSession : LspClient {
  explicit StructuredSession(const std::string& text = structured_text) : LspClient("utf-8") {
    document = name;
    open(text, document);
  }

  Json of_all(const std::string& method) {
    return request("textDocument/" + method, {{"textDocument", {{"uri", name}}},
                                              {"range",
                                               {{"start", {{"line", 0}, {"character", 0}}},
                                                {"end", {{"line", 999}, {"character", 0}}}}},
                                              {"context", Json::object()}})["result"];
  }
};

TEST(Structured, IsCheckedAsWhatItIs) {
  StructuredSession session("turns = 1\nprint turnes\n");
  EXPECT_EQ(session.codes(), (std::vector<std::string>{"unknown-name"}));
  StructuredSession good;
  // If `rnd` returns 3, the last call drives along 450 degrees.
  EXPECT_EQ(good.codes(), (std::vector<std::string>{"may-leave-range", "unstructured"}));
}

TEST(Structured, HoverSaysWhatANameStandsFor) {
  StructuredSession session;
  EXPECT_NE(session.hover(12, 14).find("**`turns`** (variable)"), std::string::npos);
  EXPECT_NE(session.hover(12, 14).find("- set: on line 12\n"), std::string::npos);
  EXPECT_NE(session.hover(12, 14).find("- the robot's `"), std::string::npos);
  EXPECT_NE(session.hover(13, 3).find("sub leg(n)\n```\ndrives one side"), std::string::npos);
  EXPECT_NE(session.hover(5, 9).find("the number 1500 (ms)"), std::string::npos);
  EXPECT_NE(session.hover(6, 4).find("elements 1 to 4"), std::string::npos);
  EXPECT_NE(session.hover(4, 10).find("(parameter)"), std::string::npos);
  EXPECT_NE(session.hover(19, 24).find("(label): jumps to it: on line 20"), std::string::npos);
  EXPECT_NE(session.hover(4, 4).find("goroll"), std::string::npos);
  EXPECT_NE(session.hover(4, 4).find("```orbstructured\ngoroll 90,128,1\n"), std::string::npos);
  EXPECT_NE(session.hover(3, 1).find("sub"), std::string::npos);
  EXPECT_EQ(session.hover(2, 4), "");
}

TEST(Structured, DefinitionsAndReferences) {
  StructuredSession session;
  EXPECT_EQ(StructuredSession::places(session.ask("definition", 13, 3)), "3:4-7");
  EXPECT_EQ(StructuredSession::places(session.ask("references", 3, 5)), "3:4-7 13:2-5 14:2-5");
  EXPECT_EQ(StructuredSession::places(session.ask("definition", 4, 9)), "3:8-9");
  EXPECT_EQ(StructuredSession::places(session.ask("references", 12, 4)),
            "12:4-5 13:6-7 14:12-13 15:5-6");
  EXPECT_EQ(StructuredSession::places(session.ask("definition", 19, 24)), "16:0-5");
  // Its declaration, not its value.
  EXPECT_EQ(StructuredSession::places(session.ask("definition", 18, 8)), "1:6-12");
}

TEST(Structured, RenameKeepsToOneMeaning) {
  StructuredSession session;
  EXPECT_EQ(session.renamed(12, 4, "lap"), "12:4-5 13:6-7 14:12-13 15:5-6");
  EXPECT_EQ(session.renamed(3, 8, "which"), "3:8-9 4:9-10 6:9-10");
  EXPECT_EQ(session.renamed(14, 7, "doubled"), "8:9-14 14:6-11");
  EXPECT_EQ(session.renamed(12, 4, "delay"), "`delay` is a reserved word");
  EXPECT_EQ(session.renamed(12, 4, "Turns"), "`Turns` is already in use");
  EXPECT_EQ(
      session.renamed(12, 4, "2nd"),
      "a name is a letter or `_`, then letters, digits and `_`, at most 31 characters in all");
  EXPECT_EQ(session.renamed(4, 3, "x"), "this is not a name in the program");
}

TEST(Structured, CompletionKnowsWhatIsVisible) {
  StructuredSession session;
  EXPECT_TRUE(session.suggests(13, 2, "leg"));
  EXPECT_TRUE(session.suggests(13, 2, "repeat"));
  EXPECT_TRUE(session.suggests(13, 2, "goroll"));
  EXPECT_FALSE(session.suggests(13, 2, "gosub"));
  EXPECT_TRUE(session.suggests(18, 6, "turns"));
  EXPECT_TRUE(session.suggests(18, 6, "twice"));
  EXPECT_FALSE(session.suggests(18, 6, "x"));
  EXPECT_TRUE(session.suggests(9, 9, "x"));
  EXPECT_TRUE(session.suggests(19, 23, "again"));
  EXPECT_FALSE(session.suggests(19, 23, "turns"));
  EXPECT_TRUE(session.suggests(7, 4, "sub"));
  StructuredSession comment("print 1 ' orb: allow \n");
  EXPECT_TRUE(comment.suggests(0, 21, "unused-name"));
  EXPECT_FALSE(comment.suggests(0, 12, "print"));
  StructuredSession colours("RGB r\nprint r\n");
  EXPECT_TRUE(colours.suggests(0, 5, "red"));
  EXPECT_TRUE(colours.suggests(0, 5, "rnd"));
  EXPECT_FALSE(colours.suggests(1, 7, "red"));
}

TEST(Structured, OutlineListsDeclarations) {
  StructuredSession session;
  const auto found = session.of_all("documentSymbol");
  std::string names;
  for (const auto& one : found)
    names += fmt::format("{}:{} ", one["name"].get<std::string>(), one["kind"].get<int>());
  EXPECT_EQ(names, "side:14 visits:18 leg:12 twice:12 "); // constant, array, functions
  EXPECT_EQ(found[2]["range"]["end"]["line"], 7);
}

TEST(Structured, FormattingAndFixes) {
  StructuredSession session("if yaw==90 then PRINT 1\n");
  const auto actions = session.of_all("codeAction");
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(actions[0]["kind"], "quickfix");
  EXPECT_EQ(actions[1]["kind"], "source.fixAll");
  StructuredSession good("if yaw=90 then PRINT 1\n");
  EXPECT_EQ(good.of_all("formatting")[0]["newText"], "if yaw = 90 then print 1\n");
}

TEST(Structured, HintsSayLettersAndBytes) {
  StructuredSession session("sub leg(n)\n  print \"a text of some length\", n\n  goroll n, 80, 1\n"
                            "  delay 1s\nend sub\nsub once\n  print 1\nend sub\n"
                            "turns = rnd(3)\nleg(turns)\nleg(2)\nleg(3)\nonce\n");
  std::string hints;
  for (const auto& hint : session.of_all("inlayHint"))
    hints += hint["position"]["line"].dump() + ":" + hint["position"]["character"].dump() +
             hint["label"].get<std::string>() + "\n";
  // `turns` is inlined and needs no letter.
  EXPECT_EQ(hints, "0:9: N\n0:1070 bytes\n5:8no bytes of its own\n");
}

TEST(Structured, OpenDocumentsAreIncluded) {
  LspClient client("utf-8");
  client.open("const pause = 5\n", "file:///robot/a%20b.orb");
  client.open("include \"a b.orb\"\ndelay pause\n", name);
  EXPECT_TRUE(client.codes().empty());
}

/// Returns `name:line:from-to` for each place in an answer.
std::string far_places(const nlohmann::json& locations) {
  std::string text;
  for (const auto& one : locations) {
    const auto uri = one["uri"].get<std::string>();
    text += (text.empty() ? "" : " ") + uri.substr(uri.rfind('/') + 1) + ":" +
            LspClient::places(nlohmann::json::array({one}));
  }
  return text;
}

class TwoFiles : public ::testing::Test {
protected:
  TwoFiles() : client("utf-8") {
    client.open("' goes a way\nsub leg(way)\n  turns += way\nend sub\n", lib);
    client.open("include \"a lib.orb\"\nturns = 1\nleg(turns)\n", main);
  }
  static inline const std::string lib = "file:///robot/a%20lib.orb";
  static inline const std::string main = "file:///robot/main.orb";
  LspClient client;
};

TEST_F(TwoFiles, DefinitionsAndReferencesAreFoundInBoth) {
  EXPECT_EQ(far_places(client.at("definition", 2, 1, nlohmann::json::object(), main)),
            "a%20lib.orb:1:4-7");
  EXPECT_EQ(far_places(client.at("references", 1, 5, nlohmann::json::object(), lib)),
            "a%20lib.orb:1:4-7 main.orb:2:0-3");
  EXPECT_EQ(far_places(client.at("references", 2, 4, nlohmann::json::object(), main)),
            far_places(client.at("references", 2, 6, nlohmann::json::object(), main)));
}

TEST(Structured, AMacroIsDefinedInItsOwnFile) {
  LspClient client("utf-8");
  client.open(".macro wink id=40\n  rgb 255 0 0\n  end\n", "file:///robot/wink.macro");
  client.open("use \"wink.macro\"\nmacrun wink\n", name);
  EXPECT_EQ(far_places(client.at("definition", 1, 8, nlohmann::json::object(), name)),
            "wink.macro:0:7-11");
}

TEST_F(TwoFiles, ANameGetsAnotherInBoth) {
  const auto rename = [&](const std::string& uri, int line, int character, const char* to) {
    return client.request("textDocument/rename",
                          {{"textDocument", {{"uri", uri}}},
                           {"position", {{"line", line}, {"character", character}}},
                           {"newName", to}});
  };
  for (const auto& changes : {rename(main, 1, 1, "course")["result"]["changes"],
                              rename(lib, 2, 3, "course")["result"]["changes"]}) {
    EXPECT_EQ(LspClient::places(changes[main]), "1:0-5 2:4-9") << changes;
    EXPECT_EQ(LspClient::places(changes[lib]), "2:2-7") << changes;
  }
  EXPECT_EQ(rename(main, 1, 1, "way")["error"]["message"], "`way` is already in use");
}

TEST_F(TwoFiles, HoverSaysWhatTheOtherFileSays) {
  const auto hover = [&](const std::string& uri, int line, int character) {
    return client.at("hover", line, character, nlohmann::json::object(), uri)["contents"]["value"]
        .get<std::string>();
  };
  EXPECT_EQ(hover(main, 2, 1),
            "```orbstructured\nsub leg(way)\n```\ngoes a way\n\nin `a lib.orb`\n");
  EXPECT_NE(hover(main, 1, 1).find("set: on lines 2, a lib.orb:3\n"), std::string::npos);
  EXPECT_NE(hover(lib, 2, 3).find("set: on lines main.orb:2, 3\n"), std::string::npos);
}

TEST_F(TwoFiles, NamesOfTheOtherFileAreSuggested) {
  client.document = main;
  EXPECT_TRUE(client.suggests(2, 0, "leg"));
}

TEST(Structured, AFileThatChangesOnTheDiskIsReadAgain) {
  Disk disk;
  LanguageServer server(&disk);
  const auto uris_after = [&](const std::string& method, nlohmann::json params) {
    std::vector<std::string> uris;
    for (const auto& out : server.receive(nlohmann::json{
             {"jsonrpc", "2.0"},
             {"method", method},
             {"params", std::move(params)}}.dump())) {
      const auto found = nlohmann::json::parse(out)["params"];
      uris.push_back(
          fmt::format("{} {}", found["uri"].get<std::string>(), found["diagnostics"].size()));
    }
    return uris;
  };
  const auto changed = [&](const char* uri) {
    return uris_after("workspace/didChangeWatchedFiles", {{"changes", {{{"uri", uri}}}}});
  };
  using Uris = std::vector<std::string>;
  server.receive(R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{}})");
  const auto opened = uris_after(
      "textDocument/didOpen",
      {{"textDocument", {{"uri", "file:///w/a.orb"}, {"text", "include \"b.orb\"\nleg\n"}}}});
  EXPECT_EQ(opened, Uris{"file:///w/a.orb 1"}) << "there is no b.orb";
  disk.texts["/w/b.orb"] = "sub leg\n  print 1\nend sub\n";
  EXPECT_EQ(changed("file:///w/b.orb"), Uris{"file:///w/a.orb 0"});
  EXPECT_EQ(changed("file:///w/c.orb"), Uris{});
  disk.texts.clear();
  EXPECT_EQ(changed("file:///w/b.orb"), Uris{"file:///w/a.orb 1"});
}

TEST(Structured, AnyTextIsAnswered) {
  for (const auto* text : {"", "\n", "sub", "sub a(\nend", "a[", "goto\n", "\"", "next\n",
                           "end if\n", "10 print 1\n", "x = y(\n", "select\ncase\n"}) {
    StructuredSession session(text);
    for (const auto* method :
         {"hover", "completion", "definition", "references", "prepareRename", "documentHighlight"})
      for (int character = 0; character < 8; ++character)
        session.ask(method, 0, character);
    for (const auto* method : {"documentSymbol", "formatting", "codeAction", "inlayHint"})
      session.of_all(method);
  }
}

} // namespace
} // namespace orb::editor
