// The language server as an editor uses it: sessions, encodings, changes, invalid messages.

#include "tests/unit/editor/client.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

constexpr int parse_error = -32700;
constexpr int invalid_request = -32600;
constexpr int method_not_found = -32601;
constexpr int invalid_params = -32602;
constexpr int not_initialized = -32002;

TEST(LspSession, NegotiatesTheEncoding) {
  const auto chosen = [](Json offered) {
    LspClient client;
    return client
        .request(
            "initialize",
            {{"capabilities",
              {{"general",
                {{"positionEncodings", offered}}}}}})["result"]["capabilities"]["positionEncoding"]
        .get<std::string>();
  };
  EXPECT_EQ(chosen(nullptr), "utf-16");
  EXPECT_EQ(chosen({"utf-16"}), "utf-16");
  EXPECT_EQ(chosen({"utf-32"}), "utf-32");
  EXPECT_EQ(chosen({"utf-16", "utf-32"}), "utf-16");
  EXPECT_EQ(chosen({"utf-16", "utf-8"}), "utf-8");
  EXPECT_EQ(chosen({"ebcdic"}), "utf-16");
}

TEST(LspSession, BeginsWithInitializeAndEndsWithExit) {
  LspClient client;
  EXPECT_EQ(client.request("textDocument/hover", {})["error"]["code"], not_initialized);
  EXPECT_TRUE(client.request("initialize", Json::object()).contains("result"));
  EXPECT_EQ(client.request("initialize", Json::object())["error"]["code"], invalid_request);
  EXPECT_TRUE(client.request("shutdown", nullptr)["result"].is_null());
  EXPECT_EQ(client.request("textDocument/hover", {})["error"]["code"], invalid_request);
  EXPECT_FALSE(client.server().ended_well().has_value());
  client.notify("exit", nullptr);
  EXPECT_EQ(client.server().ended_well(), true);
}

TEST(LspSession, ExitWithoutShutdownIsNoGoodEnd) {
  LspClient client("utf-8");
  client.notify("exit", nullptr);
  EXPECT_EQ(client.server().ended_well(), false);
}

TEST(LspSession, ChecksForTheTargetOfTheSettings) {
  LspClient client;
  client.request("initialize", {{"initializationOptions", {{"target", "1.2"}}}});
  client.open("10 raw 1,100,1,100\n20 delay 10\n30 goto 10\n");
  ASSERT_FALSE(client.codes().empty());
  EXPECT_EQ(client.diagnostics[0]["severity"], 1);
}

TEST(LspChanges, FindingsFollowEveryChange) {
  LspClient client("utf-16");
  client.open("10 rgb 255,0,0\n");
  ASSERT_EQ(client.codes(), std::vector<std::string>{"unknown-statement"});
  EXPECT_EQ(client.diagnostics[0]["range"], json_range(0, 3, 6));
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", LspClient::uri}, {"version", 2}}},
                 {"contentChanges", {{{"range", json_range(0, 3, 6)}, {"text", "RGB"}}}}});
  EXPECT_TRUE(client.codes().empty());
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", LspClient::uri}, {"version", 3}}},
                 {"contentChanges", {{{"text", "10 frobnicate\n"}}}}});
  EXPECT_EQ(client.codes(), std::vector<std::string>{"unknown-statement"});
  client.notify("textDocument/didClose", {{"textDocument", {{"uri", LspClient::uri}}}});
  EXPECT_TRUE(client.diagnostics.empty());
}

TEST(LspChanges, AChangeThatComesTooLateIsLeftOut) {
  LspClient client("utf-16");
  client.open("10 rgb 255,0,0\n");
  const auto change = [&](int version, const char* text) {
    return client.notify("textDocument/didChange",
                         {{"textDocument", {{"uri", LspClient::uri}, {"version", version}}},
                          {"contentChanges", {{{"text", text}}}}});
  };
  change(5, "10 end\n");
  EXPECT_TRUE(client.codes().empty());
  const auto said = change(4, "10 rgb 255,0,0\n");
  EXPECT_TRUE(client.codes().empty());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0]["method"], "window/logMessage");
}

TEST(LspChanges, RangesOutsideTheTextAreCutAndTurnedAround) {
  LspClient client("utf-16");
  client.open("10 end\n");
  const auto change = [&](Json range, const char* text) {
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", LspClient::uri}, {"version", nullptr}}},
                   {"contentChanges", {{{"range", std::move(range)}, {"text", text}}}}});
  };
  change(json_range(0, 6, 3), "rgb");
  EXPECT_EQ(client.codes(), std::vector<std::string>{"unknown-statement"}); // 10 rgb
  change(json_range(99, 0, 7), "20 frob\n");
  const auto codes = client.codes(); // 10 rgb, 20 frob
  EXPECT_EQ(std::count(codes.begin(), codes.end(), "unknown-statement"), 2);
  change({{"start", {{"line", 0}, {"character", 0}}},
          {"end", {{"line", 4294967295U}, {"character", 4294967295U}}}},
         "10 end\n");
  EXPECT_TRUE(client.codes().empty());
  change({{"start", {{"line", -1}, {"character", 0}}}}, "nonsense");
  EXPECT_TRUE(client.codes().empty());
}

TEST(LspChanges, ColumnsCountWhatWasNegotiated) {
  // The string contains a character of two UTF-16 units, four bytes and one code point.
  const std::string text = "10 print \"\xF0\x9F\x98\x80\"\n20 print \"\xF0\x9F\x98\x80\" rgb\n";
  const auto column = [&](const char* encoding) {
    LspClient client(encoding);
    client.open(text);
    for (const auto& one : client.diagnostics)
      if (one["severity"] == 1)
        return one["range"]["start"]["character"].get<int>();
    return -1;
  };
  EXPECT_EQ(column("utf-32"), 13);
  EXPECT_EQ(column("utf-16"), 14);
  EXPECT_EQ(column("utf-8"), 16);
}

RC_GTEST_PROP(LspChanges, ManySmallChangesAreAsGoodAsOneWhole, ()) {
  const std::vector<std::string> pieces = {"10 ",      "rgb",          "\n",     "\r\n",
                                           "20 end\n", "\"\xC3\xA9\"", "goto",   " 10 ",
                                           "'x",       "\t",           "print ", "\xF0\x9F\x98\x80",
                                           "30 RGB",   ",1",           "",       "if A=1 then "};
  const auto encoding = *rc::gen::element<std::string>("utf-8", "utf-16", "utf-32");
  LspClient client(encoding);
  LspClient whole("utf-32");
  client.open("10 end\n");
  // Edits at line starts and ends need no counting of characters: any large number means the end of
  // a line.
  std::vector<std::string> lines = {"10 end", ""};
  for (int i = 0; i < 6; ++i) {
    const auto line = *rc::gen::inRange<std::size_t>(0, lines.size());
    const bool at_end = *rc::gen::arbitrary<bool>();
    const auto piece = *rc::gen::elementOf(pieces);
    const int character = at_end ? 1000000 : 0;
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", LspClient::uri}, {"version", i + 2}}},
                   {"contentChanges",
                    {{{"range",
                       {{"start", {{"line", line}, {"character", character}}},
                        {"end", {{"line", line}, {"character", character}}}}},
                      {"text", piece}}}}});
    lines[line] = at_end ? lines[line] + piece : piece + lines[line];
    std::string text;
    for (std::size_t k = 0; k < lines.size(); ++k)
      text += lines[k] + (k + 1 < lines.size() ? "\n" : "");
    // Split again: the inserted text may contain line ends.
    lines.clear();
    std::string current;
    for (std::size_t k = 0; k < text.size(); ++k) {
      if (text[k] == '\r' && k + 1 < text.size() && text[k + 1] == '\n')
        continue;
      if (text[k] == '\n' || text[k] == '\r') {
        lines.push_back(current);
        current.clear();
      } else {
        current += text[k];
      }
    }
    lines.push_back(current);
  }
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k)
    text += lines[k] + (k + 1 < lines.size() ? "\n" : "");
  whole.open(text);
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", LspClient::uri}, {"version", 100}}},
                 {"contentChanges", Json::array()}});
  const auto formatted = [](LspClient& one) {
    return one
        .request("textDocument/documentSymbol",
                 {{"textDocument", {{"uri", LspClient::uri}}}})["result"]
        .size();
  };
  RC_ASSERT(formatted(client) == formatted(whole));
  std::size_t errors = 0;
  std::size_t wanted = 0;
  for (const auto& one : client.diagnostics)
    errors += one["severity"] == 1 ? 1 : 0;
  for (const auto& one : whole.diagnostics)
    wanted += one["severity"] == 1 ? 1 : 0;
  RC_ASSERT(errors == wanted);
}

TEST(LspNonsense, IsAnsweredAndSurvived) {
  LspClient client("utf-8");
  client.open("10 end\n");
  const auto code = [&](const std::string& text) {
    const auto said = client.send_text(text);
    return said.empty() || !said[0].contains("error") ? 0 : said[0]["error"]["code"].get<int>();
  };
  EXPECT_EQ(code("{"), parse_error);
  EXPECT_EQ(code("\xFF\xFE"), parse_error);
  EXPECT_EQ(code("[]"), invalid_request);
  EXPECT_EQ(code("7"), invalid_request);
  EXPECT_EQ(code(R"({"id":1})"), invalid_request);
  EXPECT_EQ(code(R"({"id":1,"result":null})"), 0);
  EXPECT_EQ(code(R"({"id":[],"method":"shutdown"})"), invalid_request);
  EXPECT_EQ(code(R"({"id":1,"method":"workspace/frobnicate"})"), method_not_found);
  EXPECT_EQ(
      code(
          R"({"id":1,"method":"textDocument/frobnicate","params":{"textDocument":{"uri":"file:///square.bas"}}})"),
      method_not_found);
  EXPECT_EQ(code(R"({"id":1,"method":"textDocument/hover"})"), invalid_params);
  EXPECT_EQ(code(R"({"id":1,"method":"textDocument/hover","params":[]})"), invalid_params);
  EXPECT_EQ(
      code(
          R"({"id":1,"method":"textDocument/hover","params":{"textDocument":{"uri":"file:///square.bas"},"position":{"line":-1,"character":"x"}}})"),
      invalid_params);
  EXPECT_EQ(
      code(
          R"({"id":1,"method":"textDocument/codeAction","params":{"textDocument":{"uri":"file:///square.bas"},"range":7}})"),
      invalid_params);
  EXPECT_EQ(code(R"({"method":"textDocument/didChange","params":7})"), 0);
  EXPECT_EQ(code(R"({"method":"textDocument/didOpen","params":{"textDocument":{}}})"), 0);
  EXPECT_EQ(code(R"({"method":"textDocument/didClose"})"), 0);
  EXPECT_EQ(code(R"({"method":"$/cancelRequest","params":{"id":1}})"), 0);
  // It must still work afterwards.
  EXPECT_FALSE(client.at("hover", 0, 4).is_null());
}

} // namespace
} // namespace orb::editor
