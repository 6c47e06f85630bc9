#include "compiler/text/rules.h"

#include "base/fixes.h"
#include "compiler/check.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace orb::compiler {
namespace {

bool raises(std::string_view text, const Rule& rule) {
  const auto checked = check(text, {});
  return std::any_of(checked.diagnostics.begin(), checked.diagnostics.end(),
                     [&](const Diagnostic& d) { return d.rule == &rule; });
}

TEST(Rules, EachBadExampleRaisesItsRule) {
  for (const auto& rule : rules::all())
    if (!rule.bad.empty()) {
      EXPECT_TRUE(raises(rule.bad, rule)) << rule.id;
    }
}

TEST(Rules, EachGoodExampleIsFine) {
  for (const auto& rule : rules::all())
    if (!rule.good.empty()) {
      const auto checked = check(rule.good, {});
      for (const auto& d : checked.diagnostics)
        ADD_FAILURE() << rule.id << ": " << d.rule->id << ": " << in_english(d.message);
    }
}

TEST(Rules, RowsAreWritten) {
  for (const auto& rule : rules::all()) {
    EXPECT_FALSE(rule.summary.empty()) << rule.id;
    EXPECT_FALSE(rule.explanation.empty()) << rule.id;
    EXPECT_EQ(rules::find(rule.id), &rule);
    EXPECT_EQ(rule.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
  }
  EXPECT_EQ(rules::find("no-such-rule"), nullptr);
}

TEST(Rules, ABlankIsMissingOnlyWhereSomethingFollows) {
  EXPECT_TRUE(raises("10print 1", rules::MissingBlank));
  EXPECT_TRUE(raises("70000print 1", rules::MissingBlank));
  EXPECT_FALSE(raises("10 end\n70000", rules::MissingBlank));
  EXPECT_FALSE(raises("70000\n10 end", rules::MissingBlank));
}

// Users of the library may pass texts without a final NUL; sanitizers detect reads beyond the end.
TEST(Rules, NothingIsReadBehindAText) {
  std::vector<std::string_view> texts{"10 goto \"10\""};
  for (const auto& rule : rules::all())
    texts.push_back(rule.bad);
  std::size_t findings = 0;
  for (const auto text : texts)
    for (std::size_t size = 1; size <= text.size(); ++size) {
      const std::vector<char> exact(text.begin(), text.begin() + size);
      findings += check({exact.data(), exact.size()}, {}).diagnostics.size();
    }
  EXPECT_GT(findings, 0U);
}

TEST(Rules, ANextInABranchMayHaveEndedTheLoopOrNot) {
  EXPECT_FALSE(raises("10 for I = 1 to 3\n20 if I > 1 then next I\n30 next I\n40 end\n",
                      rules::NextWithoutFor));
  EXPECT_TRUE(raises("10 for I = 1 to 3\n20 next I\n30 next I\n40 end\n", rules::NextWithoutFor));
}

// Each line starts a subroutine and also runs in all that start above it: following them separately
// would take minutes.
TEST(Rules, ManyCallsOfTheSameLinesAreFollowedTogether) {
  constexpr int calls = 2200; // as many as a file may hold
  for (const std::string last : {"end", "return"}) {
    std::string text = "1 for A=1 to 2\n2 next A\n3 on A gosub 1000";
    for (int i = 1; i < calls; ++i)
      text += "," + std::to_string(1000 + i);
    text += "\n4 end\n";
    for (int i = 0; i < calls; ++i)
      text += std::to_string(1000 + i) + " if A>0 then " + last + "\n";
    text += std::to_string(1000 + calls) + " return\n";
    EXPECT_FALSE(raises(text, rules::GosubRecursion));
    EXPECT_TRUE(raises(text, rules::ProgramTooLarge));
  }
}

TEST(Rules, AByteThatIsNotPrintableIsSeenWhereverItStands) {
  const std::string fine = "10 print \"" + std::string(150, 'a') + "\"";
  EXPECT_FALSE(raises(fine, rules::NonprintingByte));
  for (auto i = fine.find('a'); i + 1 < fine.size(); ++i)
    for (const char byte : {'\x01', '\x1F', '\x7F', '\x80', '\xFF'}) {
      auto text = fine;
      text[i] = byte;
      EXPECT_TRUE(raises(text, rules::NonprintingByte)) << i;
    }
}

// A safe fix removes its finding, and fixing again changes nothing.
TEST(Rules, FixesOfTheBadExamplesAreFinal) {
  std::size_t fixed_rules = 0;
  for (const auto& rule : rules::all()) {
    const auto checked = check(rule.bad, {});
    const bool fixable =
        std::any_of(checked.diagnostics.begin(), checked.diagnostics.end(), [&](const auto& d) {
          return d.rule == &rule && d.fix && d.fix->safety == Safety::Safe;
        });
    if (!fixable)
      continue;
    ++fixed_rules;
    const auto once = fix(std::string(rule.bad), {});
    EXPECT_FALSE(raises(once.text, rule)) << rule.id << ": " << once.text;
    const auto twice = fix(once.text, {});
    EXPECT_EQ(twice.count, 0U) << rule.id;
    EXPECT_EQ(twice.text, once.text) << rule.id;
  }
  EXPECT_GE(fixed_rules, 12U);
}

} // namespace
} // namespace orb::compiler
