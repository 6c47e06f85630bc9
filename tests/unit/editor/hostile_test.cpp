// Malformed texts: each request is answered in time.

#include "editor/dap/debug_adapter.h"
#include "tests/unit/editor/client.h"

#include <array>
#include <ctime>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
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

/// Returns the processor time of a session with the text in seconds, which does not depend on other
/// load.
double seconds_of(const std::string& ending, const std::string& text) {
  const auto begin = std::clock();
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
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

TEST(HostileText, IsAnsweredInTime) {
  // A quadratic algorithm would take minutes.
#if defined(__SANITIZE_ADDRESS__)
  constexpr double most = 200;
#else
  constexpr double most = 20;
#endif
  for (const auto& [what, text] : texts())
    for (const auto* ending : {"bas", "orb", "macro", "test"})
      EXPECT_LT(seconds_of(ending, text), most) << what << " in a ." << ending;
}

/// A disk that fails in unexpected ways.
struct BrokenDisk final : structured::Files, Folders {
  std::optional<std::string> read(const std::string&) override {
    throw std::runtime_error("a vase fell");
  }
  std::vector<std::string> sources(const std::string&) override {
    throw std::runtime_error("a vase fell");
  }
};

TEST(Hostile, ABugIsTheAnswerToOneRequest) {
  BrokenDisk disk;
  LanguageServer server(&disk, &disk);
  server.receive(R"({"id":0,"method":"initialize","params":{"rootUri":"file:///p"}})");
  const auto broken = server.receive(R"({"id":1,"method":"workspace/symbol","params":{}})");
  ASSERT_EQ(broken.size(), 1U);
  const auto answer = Json::parse(broken.front());
  EXPECT_EQ(answer["id"], 1);
  EXPECT_EQ(answer["error"]["code"], -32603);
  EXPECT_TRUE(has(answer["error"]["message"].get<std::string>(), "a vase fell"));
  const auto after = server.receive(R"({"id":2,"method":"shutdown"})");
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(Json::parse(after.front())["id"], 2);
}

/// A remote robot that records if it received a stop.
struct FarBody final : run::HeldRobot {
  explicit FarBody(int& count) : holds(count) {}
  const vm::Sample& first() const override { return sample; }
  tl::expected<void, Failure> go_on(Duration) override { return {}; }
  Duration time() const override { return {}; }
  tl::expected<std::vector<run::Felt>, Failure> hear(Duration) override {
    throw std::runtime_error("a vase fell");
  }
  tl::expected<void, Failure> hold() override {
    ++holds;
    return {};
  }
  void obey(const vm::Motion&) override {}
  void show(vm::Color) override {}
  void show_back(int) override {}
  vm::Sample sample;
  int& holds;
};

TEST(Hostile, ABugEndsADebuggerOnceItsRobotStandsStill) {
  int holds = 0;
  Disk disk;
  disk.texts["/p/a.bas"] = "10 goroll 0,60,1\n20 delay 5000\n";
  DebugAdapter adapter(disk, "/p", [&](const std::string&, const std::string&) {
    return tl::expected<std::shared_ptr<run::HeldRobot>, Failure>(std::make_shared<FarBody>(holds));
  });
  std::string said;
  const auto add = [&](const std::vector<std::string>& messages) {
    for (const auto& message : messages)
      said += message + "\n";
  };
  for (
      const auto* text :
      {R"({"seq":1,"type":"request","command":"initialize","arguments":{}})",
       R"({"seq":2,"type":"request","command":"launch","arguments":{"program":"/p/a.bas","port":"far"}})",
       R"({"seq":3,"type":"request","command":"configurationDone"})"})
    add(adapter.receive(text));
  ASSERT_TRUE(adapter.busy()) << said;
  const auto before = holds;
  for (int i = 0; i < 100 && adapter.busy(); ++i)
    add(adapter.work([] { return false; }));
  EXPECT_TRUE(adapter.broken()) << said;
  EXPECT_GT(holds, before);
  EXPECT_TRUE(has(said, "a vase fell")) << said;
  EXPECT_TRUE(has(said, R"("exitCode":70)")) << said;
}

} // namespace
} // namespace orb::editor
