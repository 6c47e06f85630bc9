// Two programs for each word of the vocabulary: one that meets the expectation, and a mutant that
// just fails it. The judge must tell them apart and name what was seen instead.

#include "base/text/text.h"
#include "testing/run_suite.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace orb::testing {
namespace {

class OneFile final : public structured::Files {
public:
  explicit OneFile(std::map<std::string, std::string> files) : files_(std::move(files)) {}
  std::optional<std::string> read(const std::string& path) override {
    const auto at = files_.find(path);
    return at == files_.end() ? std::nullopt : std::optional(at->second);
  }

private:
  std::map<std::string, std::string> files_;
};

struct Mutant {
  std::string_view word;
  std::string_view expectation; ///< the lines of the test
  std::string_view good;
  std::string_view bad;
  std::string_view seen; ///< the message about the bad one
};

constexpr std::string_view drive =
    "10 goroll 90,100,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n";

// clang-format off
constexpr auto mutants = std::to_array<Mutant>({
    {"print", "expect print \"bump\" within 1s\n", "10 print \"bump\"\n", "10 print \"bumb\"\n", "nearest \"bumb\" at 0.3 ms"},
    {"print", "expect print \"a\" 2 to 3 times\n", "10 print \"a\"\n20 print \"a\"\n", "10 print \"a\"\n", "once: at 0.3 ms"},
    {"print", "expect print /^side [1-6]$/\n", "10 print \"side\", 6\n", "10 print \"side\", 7\n", "nearest \"side 7\" at 0.3 ms"},
    {"print", "expect print ~\"ump\"\n", "10 print \"bumper\"\n", "10 print \"bunper\"\n", "nearest \"bunper\" at 0.3 ms"},
    {"print", "never print \"x\"\n", "10 print \"y\"\n", "10 print \"x\"\n", "\"x\" at 0.3 ms"},
    {"prints", "expect prints\n\"a\"\n\"b\"\n", "10 print \"a\"\n20 print \"b\"\n", "10 print \"a\"\n20 print \"c\"\n", "line 2 is \"c\" at 0.7 ms, expected \"b\""},
    {"near", "expect near 72,3 by 5cm at end\n", drive, "10 goroll 90,86,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n", "6.4 cm from 72,3 at the end, 2 s"},
    {"beyond", "expect beyond x>70\n", drive, "10 goroll 90,90,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n", "nearest x 67.4 at 1.38 s"},
    {"inside", "expect inside goal at end\n", drive, "10 goroll 90,90,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n", "2.6 cm from goal at the end, 2 s"},
    {"stay", "expect stay arena\n", "10 goroll 90,90,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n", drive, "0.01 cm from arena at 1."},
    {"heading", "expect heading 90 by 5 at 1s\n", drive, "10 goroll 84,100,1\n20 delay 1000\n", "heading 84 at 1 s"},
    {"speed", "expect speed 60..70cm/s\n", "10 goroll 0,66,1\n20 delay 1000\n", "10 goroll 0,50,1\n20 delay 1000\n", "nearest 57.0 cm/s at 1.29 s"},
    {"moving", "expect moving at 500ms\n", drive, "10 delay 1000\n", "resting at 0.5 s"},
    {"resting", "expect resting at end\n", drive, "10 goroll 90,100,1\n20 delay 1000\n", "moving at 95.3 cm/s at the end, 5 s"},
    {"distance", "expect distance 65cm..75cm\n", drive, "10 goroll 90,60,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n", "it drove 52.1 cm"},
    {"color", "expect color red by 3 during 100ms..200ms\n", "10 RGB 252,0,0\n20 delay 500\n", "10 RGB 251,0,0\n20 delay 500\n", "#FB0000 at 0.1 s"},
    {"backled", "expect backled 200..255\n", "10 backLED 200\n20 delay 100\n", "10 backLED 199\n20 delay 100\n", "nearest back LED 199 at 0.3 ms"},
    {"marker", "expect marker 3 macro wink\n", "10 macrun 40\n20 delay 100\n", "10 macrun 41\n20 delay 100\n", "marker 3 of macro 41 at 0.3 ms"},
    {"collision", "wall x=60\nexpect collision within 2s\n", drive, "10 goroll 90,60,1\n20 delay 1000\n30 goroll 90,0,0\n40 delay 1000\n", "there was no collision until 2 s"},
    {"error", "expect error \"Divide by zero\"\n", "10 A = 0\n20 A = 1 / A\n", "10 goroll 400,1,1\n", "Bad numeric parameter at 0.3 ms"},
    {"error", "never moving\n", "10 A = 1\n", "10 A = 0\n20 A = 1 / A\n", "Divide by zero"},
    {"asleep", "expect asleep within 1s\n", "10 sleep 10,0,0\n", "10 delay 1000\n", "nearest awake at 0 s"},
    {"end", "expect end within 1s\n", "10 delay 900\n", "10 delay 1100\n", "it ended at 1.1 s"},
    {"lines", "expect lines < 3\n", "10 A = 1\n20 A = 2\n", "10 A = 1\n20 A = 2\n30 A = 3\n", "3 lines"},
    {"bytes", "expect bytes < 9\n", "10 A=1\n", "10 A=1000\n", "11 bytes"},
    {"resting", "expect resting at 900ms\n", "10 goroll 0,100,1\n20 delay 100\n30 goroll 0,0,2\n40 delay 1000\n", "10 delay 1000\n", "not moved yet at 0.9 s"},
    {"color", "expect color yellow and resting for 1s\n", "10 RGB 255,255,0\n20 goroll 0,50,1\n30 delay 500\n40 goroll 0,0,0\n50 delay 2000\n", "10 RGB 255,255,0\n20 goroll 0,50,1\n30 delay 500\n40 goroll 0,0,0\n50 delay 1000\n60 RGB 255,0,0\n70 delay 3000\n", "yellow, resting for only 0."},
    {"color", "expect color red for 900ms at end\n", "10 RGB 255,0,0\n20 delay 1000\n", "10 RGB 255,0,0\n20 delay 800\n", "red for 0.8 s at the end, 0.8 s"},
    {"color", "expect color red for 900ms during 1s..1500ms\n", "10 RGB 255,0,0\n20 delay 2000\n", "10 delay 300\n20 RGB 255,0,0\n30 delay 2000\n", "red for 0.7 s at 1 s"},
    {"color", "never color red for 1s\n", "10 RGB 255,0,0\n20 delay 900\n30 RGB 0,0,0\n40 delay 10\n", "10 RGB 255,0,0\n20 delay 1100\n", "red for 1 s at 1 s"},
    {"color", "expect color green 1s after color red by 50ms\n", "10 RGB 255,0,0\n20 delay 1000\n30 RGB 0,255,0\n40 delay 10\n", "10 RGB 255,0,0\n20 delay 500\n30 RGB 0,255,0\n40 delay 1000\n", "0.5 s later, at 0.5 s"},
    {"color", "expect color green for 2s after color red\n", "10 RGB 255,0,0\n20 delay 100\n30 RGB 0,255,0\n40 delay 2100\n", "10 RGB 0,255,0\n20 delay 2100\n30 RGB 255,0,0\n40 delay 100\n", "nearest red at 2.1 s"},
    {"color", "expect color green during 1s..2s after color red\n", "10 delay 1000\n20 RGB 255,0,0\n30 delay 900\n40 RGB 0,255,0\n50 delay 2100\n", "10 RGB 255,0,0\n20 delay 1100\n30 RGB 0,255,0\n40 delay 2100\n", "red at 1 s"},
    {"print", "expect print \"2\" 1s after print \"3\" by 200ms\n", "10 print 3\n20 delay 1100\n30 print 2\n", "10 print 3\n20 print 2\n30 delay 1000\n40 print 2\n", "0.3 ms later, at 0.7 ms"},
    {"print", "expect print \"a\" 1s after print \"a\" by 200ms\n", "10 print \"a\"\n20 delay 1000\n30 print \"a\"\n", "10 print \"a\"\n20 delay 1000\n", "nothing was printed"},
    {"print", "expect print \"2\" after print \"3\"\n", "10 print 3\n20 print 2\n", "10 print 2\n20 delay 10\n", "the first event never happened: nearest \"2\" at 0.3 ms"},
    {"print", "never print \"2\" after color red\n", "10 print 2\n20 RGB 255,0,0\n", "10 RGB 255,0,0\n20 print 2\n", "\"2\" at 0.7 ms"},
    {"print", "expect print \"x\" and color red and resting\n", "10 goroll 0,50,1\n20 delay 500\n30 goroll 0,0,0\n40 delay 1000\n50 RGB 255,0,0\n60 print \"x\"\n", "10 goroll 0,50,1\n20 RGB 255,0,0\n30 delay 500\n40 print \"x\"\n50 goroll 0,0,0\n60 delay 1000\n", "\"x\" while red, moving at 41.5 cm/s at 0.5 s"},
    {"inside", "expect reach goal before print \"x\"\n", "10 goroll 90,100,1\n20 delay 1500\n30 goroll 90,0,0\n40 print \"x\"\n", "10 goroll 90,100,1\n20 print \"x\"\n30 delay 1500\n40 goroll 90,0,0\n", "the other one came first, at 0.7 ms"},
    {"inside", "never reach goal before print \"x\"\n", "10 print \"x\"\n20 goroll 90,100,1\n30 delay 1200\n40 goroll 90,0,0\n", "10 goroll 90,100,1\n20 delay 1500\n30 goroll 90,0,0\n40 print \"x\"\n", "it came first, at "},
    {"inside", "never reach goal during 0s..2s\n", "10 goroll 90,50,1\n20 delay 500\n30 goroll 90,0,0\n", "10 goroll 90,255,1\n20 delay 1200\n", "in goal at "},
    {"variable", "expect A = 5 at end\n", "10 A = 5\n", "10 A = 6\n", "A = 6"},
});
// clang-format on

constexpr std::string_view course =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200" viewBox="-100 -100 200 200">
<circle class="start" cx="0" cy="0" r="3"/>
<rect class="zone" id="goal" x="70" y="-10" width="30" height="20"/>
<rect class="zone" id="arena" x="-20" y="-20" width="90" height="40"/>
</svg>)";
constexpr std::string_view macros = ".macro wink id=40\nmarker 3\n.macro nod id=41\nmarker 3\n";

CaseResult judge(const Mutant& mutant, std::string_view program) {
  OneFile files({{"m.bas", std::string(program)},
                 {"m.macro", std::string(macros)},
                 {"m.svg", std::string(course)}});
  auto suite =
      make_suite({{"m.test", fmt::format("program m.bas\nwith m.macro\ncourse m.svg\nfor 5s\n{}",
                                         mutant.expectation)}},
                 {}, files);
  EXPECT_TRUE(suite.has_value());
  EXPECT_FALSE(suite->has_errors()) << in_english(suite->files[0].file.diagnostics[0].message);
  return run_case(*suite, suite->groups.front(), 1, nullptr, nullptr);
}

TEST(Mutants, EachWordTellsAGoodProgramFromABadOne) {
  for (const auto& mutant : mutants) {
    const auto good = judge(mutant, mutant.good);
    EXPECT_EQ(good.verdict, Verdict::Passed)
        << mutant.expectation
        << (good.misses.empty() ? good.problem : in_english(good.misses[0].seen));
    const auto bad = judge(mutant, mutant.bad);
    ASSERT_EQ(bad.verdict, Verdict::Failed) << mutant.expectation << bad.problem;
    const auto seen = in_english(bad.misses.front().seen);
    EXPECT_TRUE(seen.starts_with(mutant.seen)) << mutant.expectation << seen;
    EXPECT_FALSE(bad.again.empty());
  }
}

TEST(Mutants, EveryWordHasOne) {
  std::set<std::string_view> tried;
  for (const auto& mutant : mutants)
    tried.insert(mutant.word);
  for (const auto& row : expectations)
    EXPECT_TRUE(tried.contains(row.word)) << row.word;
}

} // namespace
} // namespace orb::testing
