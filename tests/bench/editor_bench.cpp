// Measures the time from a keystroke to the findings: the language server receives a change of one
// character in a program of 4 KB and answers, JSON to JSON, in this process.

#include "editor/lsp/language_server.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace {

using Json = nlohmann::json;

constexpr std::size_t size = 4096;

std::string basic_program() {
  std::string text = "5 A = 0\n";
  for (int line = 10; text.size() < size; line += 10)
    text += line % 50 == 0
                ? fmt::format("{} if A < {} then goto {} else A = A + 1\n", line, line, line - 10)
                : fmt::format("{} goroll (A * {}) % 360, {}, 1 'turn\n", line, line, line % 200);
  return text;
}

std::string structured_program() {
  std::string text = "const side = 400ms\ncourse = 0\n";
  for (int n = 0; text.size() < size; ++n)
    text +=
        fmt::format("for round_{0} = 1 to 3\n  leg_{0}(round_{0} * {1})\nnext round_{0}\n"
                    "sub leg_{0}(turn)\n  course = (course + turn) % 360\n"
                    "  goroll course, {2}, 1\n  delay side\n  if course > {1} then print \"far\"\n"
                    "end sub\n",
                    n, 10 + n, 60 + n % 90);
  return text;
}

std::string macro_source() {
  std::string text;
  for (int n = 0; text.size() < size; ++n)
    text += fmt::format(".macro leg_{0} id={1}\nroll {2}, 90, delay=200ms\nrgb 0, 128, {2}\n"
                        "delay 1500 # go on\n",
                        n, 40 + n % 200, n % 250);
  return text;
}

std::string test_file() {
  std::string text = "program a.bas\n";
  for (int n = 0; text.size() < size; ++n)
    text += fmt::format("test \"number {}\" points 2\n  at 1s shake\n"
                        "  expect print \"side {}\" within 10s\n  never collision\n",
                        n, n);
  return text;
}

/// 200 lines; every 16th has a beginner's mistake.
std::string broken(const std::string& ending) {
  constexpr int lines = 200;
  std::string text;
  for (int n = 1; n <= lines; ++n) {
    const bool wrong = n % 16 == 0;
    if (ending == "bas")
      text += wrong ? fmt::format("{} wait {} sec\n", n * 10, n)
                    : fmt::format("{} goroll {},{},1\n", n * 10, n, 50 + n % 100);
    else if (ending == "orb")
      text += wrong ? fmt::format("if x == {}: print(\"a\")\n", n)
                    : fmt::format("goroll {}, {}, 1\n", n, 50 + n % 100);
    else if (ending == "macro")
      text += wrong ? fmt::format("wait({} sec)\n", n) : fmt::format("rgb {}, 0, 0, 200ms\n", n);
    else
      text += wrong ? fmt::format("expct colour is red in {} seconds\n", n)
                    : fmt::format("expect print \"{}\" within 10s\n", n);
  }
  return text;
}

void keystroke(benchmark::State& state, const std::string& name, const std::string& text) {
  orb::editor::LanguageServer server;
  const auto tell = [&](const char* method, Json params) {
    return server.receive(Json{{"method", method}, {"params", std::move(params)}}.dump());
  };
  server.receive(R"({"id":1,"method":"initialize","params":{}})");
  tell("textDocument/didOpen", {{"textDocument", {{"uri", name}, {"version", 1}, {"text", text}}}});
  const Json last{{"line", 3}, {"character", 0}};
  const auto change = [&](const char* put) {
    const bool types = *put != '\0';
    const Json end{{"line", 3}, {"character", types ? 0 : 1}};
    return tell("textDocument/didChange",
                {{"textDocument", {{"uri", name}}},
                 {"contentChanges",
                  Json::array({{{"range", {{"start", last}, {"end", end}}}, {"text", put}}})}});
  };
  for (auto _ : state) {
    if (change(" ").empty() || change("").empty())
      state.SkipWithError("no findings came");
  }
  state.SetItemsProcessed(2 * state.iterations()); // one typed, one deleted
}

} // namespace

BENCHMARK_CAPTURE(keystroke, basic, "a.bas", basic_program())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, structured, "a.orb", structured_program())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, macro, "a.macro", macro_source())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, test, "a.test", test_file())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, broken_basic, "b.bas", broken("bas"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, broken_structured, "b.orb", broken("orb"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, broken_macro, "b.macro", broken("macro"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(keystroke, broken_test, "b.test", broken("test"))->Unit(benchmark::kMillisecond);
