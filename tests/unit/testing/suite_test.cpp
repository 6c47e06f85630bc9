// Results do not depend on the number of threads or machines, which transcripts cannot show.

#include "base/random.h"
#include "testing/run_suite.h"
#include "testing/text/rules.h"
#include "testing/verdicts/merge.h"
#include "testing/verdicts/render.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace orb::testing {
namespace {

class TwoFiles final : public structured::Files {
public:
  std::optional<std::string> read(const std::string& path) override {
    if (path == "a.bas")
      return "10 print \"side\", rnd 5\n20 goroll rnd 359,100,1\n30 delay 500\n";
    if (path == "b.bas")
      return "10 goroll rnd 100,80,1\n20 delay 500\n30 print \"side 3\"\n";
    return std::nullopt;
  }
};

Suite make() {
  TwoFiles files;
  SuiteOptions options;
  options.programs = {"a.bas", "b.bas"};
  auto suite = make_suite({{"a.test", "test \"one\" seeds 1..30\nexpect print \"side 3\"\n"
                                      "test \"two\" seeds 5..25\nexpect near 10,10 by 20cm\n"},
                           {"b.test", "seeds 1..7\nnever beyond x>10\n"}},
                          options, files);
  EXPECT_TRUE(suite.has_value() && !suite->has_errors());
  return *std::move(suite);
}

class Silent final : public Progress {
public:
  void on_cases(std::uint64_t done, std::uint64_t all) override {
    EXPECT_LE(done, all);
    EXPECT_GE(done, last);
    last = done;
  }
  std::uint64_t last = 0;
};

Results run(const Suite& suite, unsigned jobs, Shard shard = {}) {
  Silent progress;
  return run_suite(suite, {jobs, shard, {}}, progress);
}

TEST(Suite, ResultsDoNotDependOnJobs) {
  const auto suite = make();
  const auto one = render_json(run(suite, 1));
  EXPECT_EQ(one, render_json(run(suite, 4)));
  EXPECT_EQ(one, render_json(run(suite, 64)));
  EXPECT_NE(one.find("failed"), std::string::npos);
  EXPECT_NE(one.find("passed"), std::string::npos);
}

TEST(Suite, ShardsInAnyOrderAreTheWhole) {
  const auto suite = make();
  const auto whole = render_json(run(suite, 1));
  for (const std::uint64_t count : {2U, 3U, 16U, 500U}) {
    std::vector<Part> parts;
    for (auto index = count; index >= 1; --index) {
      const auto text = render_json(run(suite, 2, {index, count}));
      auto part = read_results(fmt::format("{}.json", index), text);
      ASSERT_TRUE(part.has_value());
      EXPECT_EQ(render_json(part->results), text);
      parts.push_back(*std::move(part));
    }
    std::swap(parts.front(), parts[parts.size() / 2]);
    const auto joined = merge(std::move(parts));
    ASSERT_TRUE(joined.has_value()) << joined.error().message;
    EXPECT_EQ(render_json(*joined), whole);
  }
}

std::string refusal(const Suite& suite, std::initializer_list<std::uint64_t> shards) {
  std::vector<Part> parts;
  for (const auto index : shards)
    parts.push_back({"p", run(suite, 1, {index, 3})});
  const auto joined = merge(std::move(parts));
  return joined ? std::string() : joined.error().message;
}

TEST(Suite, PartsThatDoNotMakeAWholeAreRefused) {
  const auto suite = make();
  EXPECT_EQ(refusal(suite, {3, 1, 2}), "");
  EXPECT_EQ(refusal(suite, {1, 3}), "39 runs are missing: those of shard 2/3");
  EXPECT_NE(refusal(suite, {1, 2, 2, 3}).find("is in two files"), std::string::npos);
  EXPECT_FALSE(read_results("x", "{}").has_value());
  EXPECT_FALSE(read_results("x", "{\"schema\":\"orb.test/1\",\"cases\":1}").has_value());
}

TEST(Suite, AFailureWithoutAReasonIsNoResult) {
  auto text = render_json(run(make(), 1));
  const auto passed = text.find("passed");
  text.replace(passed, 6, "failed");
  EXPECT_FALSE(read_results("x", text).has_value());
  text.replace(passed, 6, "error ");
  EXPECT_FALSE(read_results("x", text).has_value());
}

TEST(TestRules, EachBadExampleIsToldAndEachGoodOneIsNot) {
  for (const auto& rule : rules::all()) {
    const auto told = [&](std::string_view text) {
      const Source source("x.test", std::string(text));
      const auto found = parse(source).diagnostics;
      return std::any_of(found.begin(), found.end(),
                         [&](const Diagnostic& one) { return one.rule == &rule; });
    };
    const bool needs_files =
        &rule == &rules::File || &rule == &rules::NoProgram || &rule == &rules::Zone ||
        &rule == &rules::Variable || &rule == &rules::Macro || &rule == &rules::KeptVariable ||
        &rule == &rules::OtherLetters || &rule == &rules::OffTheWay || &rule == &rules::JavaScript;
    EXPECT_NE(told(rule.bad), needs_files) << rule.id;
    EXPECT_FALSE(told(rule.good)) << rule.id;
  }
}

TEST(TestFiles, AnyTextIsRead) {
  constexpr std::string_view pieces[] = {
      "expect ",  "never ",   "print ", "near ",  "1,2 ",    "by ",     "12cm ",   "\"a\" ",
      "/x/ ",     "~",        "test ",  "at ",    "end ",    "within ", "2s..3s ", "..",
      "color ",   "#FF0000 ", "times ", "to ",    "points ", "5 ",      "-",       "\n",
      "wall x=3", "error ",   "0Ah ",   "A = 3 ", "\x80",    "reach "};
  Random random{7};
  for (int i = 0; i < 10000; ++i) {
    std::string text;
    for (auto more = random.below(12); more > 0; --more)
      text += pieces[random.below(std::size(pieces))];
    const Source source("x.test", text);
    for (const auto& found : parse(source).diagnostics)
      ASSERT_LE(found.span.end, text.size()) << text;
  }
}

TEST(Patterns, AreBoundedInTime) {
  const auto slow = Pattern::compile("(a+)+$");
  ASSERT_TRUE(slow.has_value());
  std::string nearly(60, 'a');
  nearly += 'b';
  EXPECT_EQ(slow->search(nearly), Pattern::Found::GaveUp);
  EXPECT_EQ(slow->search("aaa"), Pattern::Found::Yes);
  const auto deep = Pattern::compile("(?:a|b)*c");
  ASSERT_TRUE(deep.has_value());
  EXPECT_NE(deep->search(std::string(4000, 'a')), Pattern::Found::Yes);
  std::string nested(60, '(');
  nested.append(60, ')');
  EXPECT_FALSE(Pattern::compile(nested).has_value());
}

} // namespace
} // namespace orb::testing
