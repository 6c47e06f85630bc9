// Texts that nobody writes: each request is answered, in time.

#include "tests/unit/editor/client.h"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

struct Text {
  std::string_view what;
  std::string text;
};

std::string repeated(std::string_view part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i)
    text += part;
  return text;
}

std::vector<Text> texts() {
  constexpr std::size_t many = 16000;
  constexpr std::size_t tokens = 60000;
  std::string noise;
  for (std::uint32_t x = 1; noise.size() < 200000; x = x * 1664525 + 1013904223)
    noise += static_cast<char>(' ' + (x >> 24) % 96);
  return {
      {"a line of 60,000 tokens", "10 print " + repeated("A ", tokens) + "\n"},
      {"60,000 values", "10 data " + repeated("1,", tokens) + "1\n"},
      {"a long sum", "x = " + repeated("a + ", tokens) + "1\n"},
      {"var, again and again", repeated("var ", many) + "\n"},
      {"not, again and again", "if " + repeated("not ", many) + "x then end\n"},
      {"deep parentheses", "10 A = " + repeated("(", many) + "1" + repeated(")", many) + "\n"},
      {"deep brackets", "a = " + repeated("x[", many) + "1" + repeated("]", many) + "\n"},
      {"deep blocks", repeated("while 1\n", many)},
      {"braces", repeated("if a {", many) + "\n"},
      {"quotes", repeated("print \"", many) + "\n"},
      {"letters of other alphabets", repeated("print “ü😀 ", many) + "\n"},
      {"line ends of three kinds", repeated("10 cls\r20 cls\n30 cls\r\n", many / 4)},
      {"expectations in a row", repeated("expect color red and ", many) + "\n"},
      {"noise", noise},
  };
}

Json place(int line, int character) {
  return {{"line", line}, {"character", character}};
}

/// The seconds that a session with the text takes.
double seconds_of(const std::string& ending, const std::string& text) {
  const auto begin = std::chrono::steady_clock::now();
  LspClient client("utf-16");
  const auto uri = "file:///hostile." + ending;
  const Json document{{"uri", uri}};
  client.notify("textDocument/didOpen",
                {{"textDocument", {{"uri", uri}, {"version", 1}, {"text", text}}}});
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", uri}, {"version", 2}}},
                 {"contentChanges",
                  {{{"range", {{"start", place(0, 1)}, {"end", place(0, 1)}}}, {"text", "1"}}}}});
  const Json all{{"start", place(0, 0)}, {"end", place(100, 0)}};
  const auto ask = [&](const char* method, Json params) {
    params["textDocument"] = document;
    const auto answer = client.request(method, params);
    EXPECT_TRUE(answer.contains("result") || answer.contains("error")) << method;
  };
  for (const auto* method :
       {"documentSymbol", "foldingRange", "semanticTokens/full", "codeLens", "documentLink"})
    ask((std::string("textDocument/") + method).c_str(), Json::object());
  for (const auto* method :
       {"hover", "completion", "definition", "documentHighlight", "signatureHelp"})
    ask((std::string("textDocument/") + method).c_str(), {{"position", place(0, 20)}});
  ask("textDocument/references",
      {{"position", place(0, 20)}, {"context", {{"includeDeclaration", true}}}});
  ask("textDocument/rename", {{"position", place(0, 20)}, {"newName", "b"}});
  ask("textDocument/codeAction", {{"range", all}, {"context", {{"diagnostics", Json::array()}}}});
  ask("textDocument/inlayHint", {{"range", all}});
  ask("textDocument/selectionRange", {{"positions", {place(0, 20)}}});
  ask("textDocument/formatting", {{"options", {{"tabSize", 2}, {"insertSpaces", true}}}});
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(HostileText, IsAnsweredInTime) {
  constexpr double most = 20; // seconds of a session; with a quadratic answer it is minutes
  for (const auto& [what, text] : texts())
    for (const auto* ending : {"bas", "orb", "macro", "test"})
      EXPECT_LT(seconds_of(ending, text), most) << what << " in a ." << ending;
}

} // namespace
} // namespace orb::editor
