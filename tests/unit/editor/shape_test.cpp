// The language server's answers about the shape of a text: colours, folds, selection ranges,
// signatures, links, lenses, calls.

#include "editor/languages/shape.h"
#include "tests/unit/editor/client.h"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck/gtest.h>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

/// Returns `word:color` for each coloured piece, with `+` and the numbers of its traits.
std::string colored(const LanguageService& language, const std::string& text,
                    const LanguageOptions& options = {}) {
  const Source source("a", text);
  std::string out;
  for (const auto& one : language.shape->colors(source, options)) {
    out += fmt::format("{}{}:{}", out.empty() ? "" : " ", source.text(one.span),
                       color_names[static_cast<std::size_t>(one.color)]);
    for (std::size_t trait = 0; trait < trait_names.size(); ++trait)
      if ((one.traits >> trait & 1U) != 0)
        out += fmt::format("+{}", trait_names[trait]);
  }
  return out;
}

std::string folded(const LanguageService& language, const std::string& text) {
  std::string out;
  for (const auto& fold : language.shape->folds(Source("a", text)))
    out += fmt::format("{}{}-{}", out.empty() ? "" : " ", fold.first, fold.last);
  return out;
}

/// Returns the signature at the `|` in `text`, with the active parameter in angle brackets.
std::string signed_at(const LanguageService& language, std::string text) {
  const auto at = text.find('|');
  text.erase(at, 1);
  const auto found =
      language.shape->signature(Source("a", text), static_cast<std::uint32_t>(at), {});
  if (!found)
    return "";
  if (found->active >= found->parameters.size())
    return found->label;
  const auto place = found->parameters[found->active].in_label;
  return found->label.substr(0, place.begin) + "<" +
         found->label.substr(place.begin, place.size()) + ">" + found->label.substr(place.end);
}

std::string around(const LanguageService& language, std::string text) {
  const auto at = static_cast<std::uint32_t>(text.find('|'));
  text.erase(at, 1);
  const Source source("a", text);
  std::vector<std::string> texts;
  for (const auto span : nested(source, at, language.shape->around(source, at)))
    texts.emplace_back(source.text(span));
  return fmt::format("{}", fmt::join(texts, " < "));
}

TEST(Colors, TellWhatNamesStandFor) {
  EXPECT_EQ(colored(basic_service, "10 A=speed+1 'x\n20 goto 10"),
            "10:label+declaration A:variable+modification =:operator "
            "speed:variable+readonly+defaultLibrary +:operator 1:number 'x:comment "
            "20:label+declaration goto:keyword 10:label");
  EXPECT_EQ(colored(structured_service, "const a = 2\nsub f(b)\n  c = a * b\nend sub\nf(c)\n"),
            "const:keyword a:variable+declaration+readonly =:operator 2:number sub:keyword "
            "f:function+declaration b:parameter+modification c:variable+modification =:operator "
            "a:variable+readonly *:operator b:parameter end:keyword sub:keyword f:function "
            "c:variable");
  EXPECT_EQ(colored(macro_service, ".macro spin id=40\nroll 90, heading=90 # go\ngoto spin\n"),
            ".macro:keyword spin:function+declaration id:parameter 40:number "
            "roll:function+defaultLibrary 90:number heading:parameter 90:number # go:comment "
            "goto:function+defaultLibrary spin:function");
  EXPECT_EQ(colored(test_service, "course a.svg\ntest \"t\"\n  expect print /b+/ within 2s\n"),
            "course:keyword a.svg:string test:keyword \"t\":string expect:keyword print:function+"
            "defaultLibrary /b+/:regexp within:keyword 2s:number");
  EXPECT_EQ(colored(stimulus_service, "at 2.5s shake # now\n"),
            "at:keyword 2.5s:number shake:function+defaultLibrary # now:comment");
}

TEST(Folds, HideBlocksSubroutinesMacrosTests) {
  EXPECT_EQ(folded(basic_service, "'a\n'b\n10 gosub 50\n20 for X=1 to 3\n30 ?X\n40 next X\n"
                                  "50 ?1\n60 return\n"),
            "1-2 7-8 4-5");
  EXPECT_EQ(folded(structured_service,
                   "if a then\n  ?1\nelse\n  ?2\nend if\nrepeat 3\n  ?3\nend repeat\n"),
            "1-2 3-4 6-7");
  EXPECT_EQ(folded(macro_service, ".macro a id=40\nroll 1,2\n\n.macro b id=41\nloop_start 3\n"
                                  "delay 5\nloop_end\n\n"),
            "1-2 4-7 5-6");
  EXPECT_EQ(folded(test_service, "test \"a\"\n  never error\n\ntest \"b\"\n  expect resting\n"),
            "1-2 4-5");
}

TEST(Around, GrowsFromTheWordToTheText) {
  EXPECT_EQ(around(structured_service, "loop\n  delay 5 * (2 + |3)\nend loop\n"),
            "3 < 2 + 3 < 5 * (2 + 3) < delay 5 * (2 + 3) <   delay 5 * (2 + 3) < "
            "\n  delay 5 * (2 + 3)\n < loop\n  delay 5 * (2 + 3)\nend loop < "
            "loop\n  delay 5 * (2 + 3)\nend loop\n");
  EXPECT_EQ(around(basic_service, "10 goroll 9|0,1,1\n20 end\n"),
            "90 < goroll 90,1,1 < 10 goroll 90,1,1 < 10 goroll 90,1,1\n20 end\n");
  EXPECT_EQ(around(macro_service, "roll 1, heading=2|\n"),
            "2 < heading=2 < roll 1, heading=2 < roll 1, heading=2\n");
}

TEST(Signatures, SayWhatComesNext) {
  EXPECT_EQ(signed_at(basic_service, "10 goroll |"), "goroll <heading>, speed, go");
  EXPECT_EQ(signed_at(basic_service, "10 if A=1 then RGB 1,abs(2),|"), "RGB red, green, <blue>");
  EXPECT_EQ(signed_at(basic_service, "10 end |"), "");
  EXPECT_EQ(signed_at(structured_service, "sub leg(n, turn)\nend sub\nleg(1, |"), "leg(n, <turn>)");
  EXPECT_EQ(signed_at(structured_service, "if x then goroll (1 + 2), |"),
            "goroll heading, <speed>, go");
  EXPECT_EQ(signed_at(structured_service, "x = min(1|"), "min(E, E)");
  EXPECT_EQ(signed_at(macro_service, "roll speed=3, |"), "roll speed, <heading>, delay");
  EXPECT_EQ(signed_at(macro_service, "roll delay=|"), "roll speed, heading, <delay>");
  EXPECT_EQ(signed_at(test_service, "test \"a\"\nexpect near |"), "near X,Y|BALL by LENGTH");
  EXPECT_EQ(signed_at(stimulus_service, "at 3s push |"), "push HEADING STRENGTH");
}

TEST(Hints, SaySecondsAndDirections) {
  const auto hinted = [](const LanguageService& language, const std::string& text) {
    const Source source("a", text);
    std::string out;
    for (const auto& hint : language.hints(source, {}))
      out += fmt::format("{}{}:{}", out.empty() ? "" : " ", hint.at, hint.label);
    return out;
  };
  EXPECT_EQ(hinted(basic_service, "10 goroll 270,9,1\n20 delay 1500\n30 delay 999\n"),
            "13:← 31:1.5 s");
  EXPECT_EQ(hinted(macro_service, "roll 9, 44\nroll 9, 90deg\ndelay 2000\n"), "10:↗ 24:→ 35:2 s");
  EXPECT_EQ(hinted(structured_service, "const w = 2000\ndelay w\ndelay 3s\n"), "22:2 s");
}

TEST(Links, LeadToTheFilesThatAreNamed) {
  const auto linked = [](const LanguageService& language, const std::string& text) {
    std::string out;
    for (const auto& link : language.shape->links(Source("file:///d/a", text)))
      out += fmt::format("{}{}={}", out.empty() ? "" : " ", link.span.begin, link.path);
    return out;
  };
  EXPECT_EQ(linked(structured_service, "use \"m.macro\"\ninclude \"../l.orb\"\n"),
            "5=/d/m.macro 23=/l.orb");
  EXPECT_EQ(linked(test_service, "program p.bas\ncourse c.svg\nwith m.macro\n"),
            "8=/d/p.bas 21=/d/c.svg 32=/d/m.macro");
}

TEST(Lenses, RunProgramsAndTests) {
  LspClient client("utf-8");
  const auto titles = [&](const std::string& uri, const std::string& text) {
    client.open(text, uri);
    std::string out;
    const auto lenses = client.request("textDocument/codeLens", {{"textDocument", {{"uri", uri}}}});
    for (const auto& lens : lenses["result"])
      out += lens["command"]["title"].get<std::string>() + lens["command"]["arguments"].dump();
    return out;
  };
  EXPECT_EQ(titles("file:///a.bas", "10 end\n"), "run[\"file:///a.bas\"]debug[\"file:///a.bas\"]");
  EXPECT_EQ(titles("file:///b.bas", " \n"), "");
  EXPECT_EQ(titles("file:///a.test", "test \"t\"\n"),
            "run all tests[\"file:///a.test\",\"\"]run test[\"file:///a.test\",\"t\"]"
            "debug test[\"file:///a.test\",\"t\"]");
}

TEST(Calls, AreFoundInBothDirections) {
  LspClient client("utf-8");
  client.document = "file:///a.orb";
  client.open("one\nsub one\n  two\n  two\nend sub\nsub two\nend sub\n", client.document);
  const auto items = client.ask("prepareCallHierarchy", 2, 3);
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(items[0]["name"], "two");
  const auto in = client.request("callHierarchy/incomingCalls", {{"item", items[0]}})["result"];
  ASSERT_EQ(in.size(), 1U);
  EXPECT_EQ(in[0]["from"]["name"], "one");
  EXPECT_EQ(in[0]["fromRanges"].size(), 2U);
  const auto out =
      client.request("callHierarchy/outgoingCalls", {{"item", in[0]["from"]}})["result"];
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0]["to"]["name"], "two");
  client.document = "file:///a.bas";
  client.open("10 gosub 50\n20 end\n50 gosub 70\n60 return\n70 return\n", client.document);
  const auto inner = client.ask("prepareCallHierarchy", 4, 0);
  ASSERT_EQ(inner.size(), 1U);
  const auto callers =
      client.request("callHierarchy/incomingCalls", {{"item", inner[0]}})["result"];
  ASSERT_EQ(callers.size(), 1U);
  EXPECT_EQ(callers[0]["from"]["name"], "50");
  EXPECT_EQ(client.request("callHierarchy/incomingCalls", {{"item", 7}})["error"]["code"], -32602);
}

TEST(Completion, KnowsTheZonesOfTheCourse) {
  Disk disk;
  disk.texts["/hall.svg"] = R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">
    <rect class="zone" id="goal" width="2" height="2"/></svg>)";
  LanguageOptions options;
  options.files = &disk;
  const auto first = [&](const std::string& line) {
    const std::string text = "course hall.svg\ntest \"t\"\n" + line;
    const auto found = test_service.suggest(Source("file:///a.test", text),
                                            static_cast<std::uint32_t>(text.size()), options);
    return found.items.empty() ? "" : found.items.front().label;
  };
  EXPECT_EQ(first("reach "), "goal");
  EXPECT_EQ(first("expect inside g"), "goal");
  EXPECT_EQ(first("expect stay "), "goal");
  EXPECT_EQ(first("expect inside goal "), "within");
}

TEST(Cancelling, SparesARequestThatWaits) {
  LanguageServer server;
  const auto codes_of = [&] {
    std::vector<int> codes;
    while (server.has_waiting())
      for (const auto& text : server.answer_next()) {
        const auto answer = Json::parse(text);
        if (answer.contains("id"))
          codes.push_back(answer.contains("error") ? answer["error"]["code"].get<int>() : 0);
      }
    return codes;
  };
  server.take(R"({"id":1,"method":"initialize","params":{}})");
  server.take(R"({"id":2,"method":"workspace/symbol","params":{"query":""}})");
  server.take(R"({"id":3,"method":"workspace/symbol","params":{"query":""}})");
  server.take(R"({"method":"$/cancelRequest","params":{"id":2}})");
  server.take(R"({"method":"$/cancelRequest","params":{}})");
  EXPECT_EQ(codes_of(), (std::vector<int>{0, -32800, 0}));
  server.take(R"({"method":"$/cancelRequest","params":{"id":3}})"); // too late
  EXPECT_TRUE(codes_of().empty());
}

class SomeFolders final : public Folders {
public:
  std::vector<std::string> sources(const std::string& root) override {
    return {root + "/far.orb", root + "/gone.orb"};
  }
};

TEST(WorkspaceSymbols, AreThoseOfOpenTextsAndFolders) {
  Disk disk;
  disk.texts["/w/far.orb"] = "sub far_away\nend sub\n";
  SomeFolders folders;
  LanguageServer server(&disk, &folders);
  server.receive(R"({"id":1,"method":"initialize","params":{"rootUri":"file:///w"}})");
  server.receive(R"({"method":"textDocument/didOpen","params":{"textDocument":{
    "uri":"file:///b.orb","text":"sub fast\nend sub\nsub slow\nend sub\n"}}})");
  const auto names = [&](const std::string& query) {
    const Json request{{"id", 2}, {"method", "workspace/symbol"}, {"params", {{"query", query}}}};
    std::string out;
    const auto answer = Json::parse(server.receive(request.dump()).front());
    for (const auto& one : answer["result"])
      out += one["name"].get<std::string>() + " ";
    return out;
  };
  EXPECT_EQ(names("FA"), "fast far_away ");
  EXPECT_EQ(names("sl"), "slow ");
}

// ---- any text

constexpr auto services = std::to_array<const LanguageService*>(
    {&basic_service, &structured_service, &macro_service, &test_service, &stimulus_service});

std::string any_text() {
  static const std::vector<std::string> pieces{
      "\n",     "\n10 ",        " ",        ",",        "(",      ")",        "\"",     "'",
      "#",      "for",          " X=1 to",  "next X",   "sub",    " f(a, b)", "end ",   "if",
      " then",  "else",         "gosub ",   "50",       ".macro", " m id=40", "roll ",  "goto ",
      "m",      "loop_start 3", "loop_end", "test ",    "\"t\" ", "expect ",  "print ", "/a/",
      "at 2s",  "shake",        "use ",     "\xC3\xA9", "\xFF",   "const a=", "loop",   "end loop",
      "repeat", "until",        "select 1", "case 1",   "\r"};
  const auto chosen = *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(pieces));
  std::string text;
  for (const auto& piece : chosen)
    text += piece;
  return text;
}

RC_GTEST_PROP(AnyShape, HoldsTogether, ()) {
  const Source source("a.orb", any_text());
  const auto size = static_cast<std::uint32_t>(source.text().size());
  const auto at = *rc::gen::inRange<std::uint32_t>(0, size + 1);
  for (const auto* language : services) {
    std::uint32_t last = 0;
    for (const auto& one : language->shape->colors(source, {})) {
      RC_ASSERT(last <= one.span.begin);
      RC_ASSERT(one.span.begin < one.span.end);
      RC_ASSERT(one.span.end <= size);
      last = one.span.end;
    }
    for (const auto& fold : language->shape->folds(source)) {
      RC_ASSERT(fold.first >= 1U);
      RC_ASSERT(fold.first < fold.last);
      RC_ASSERT(fold.last <= source.line_count());
    }
    const auto chain = nested(source, at, language->shape->around(source, at));
    RC_ASSERT(!chain.empty());
    RC_ASSERT(chain.back() == (Span{0, size}));
    for (std::size_t i = 0; i < chain.size(); ++i) {
      RC_ASSERT(touches(chain[i], at));
      // RC_ASSERT evaluates both sides of an || that it sees.
      RC_ASSERT((i == 0 || (chain[i].begin <= chain[i - 1].begin &&
                            chain[i - 1].end <= chain[i].end && chain[i] != chain[i - 1])));
    }
    if (const auto found = language->shape->signature(source, at, {}))
      for (const auto& parameter : found->parameters)
        RC_ASSERT(parameter.in_label.end <= found->label.size());
    if (language->shape->calls != nullptr)
      for (const auto all = language->shape->calls(source, {}); const auto& call : all.calls) {
        RC_ASSERT(call.caller < all.callables.size());
        RC_ASSERT(call.callee < all.callables.size());
      }
  }
}

} // namespace
} // namespace orb::editor
