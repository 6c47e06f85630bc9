#include "structured/text/rules.h"

#include "base/fixes.h"
#include "structured/compile.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace orb::structured {
namespace {

Compiled compile_text(std::string_view text) {
  NoFiles files;
  return compile("test.orb", "test.orb", text, {}, files);
}

TEST(Rules, EachBadExampleRaisesItsRule) {
  for (const auto& rule : rules::all())
    if (!rule.bad.empty()) {
      const auto found = compile_text(rule.bad).program.diagnostics;
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Diagnostic& d) {
        return d.rule == &rule;
      })) << rule.id;
    }
}

TEST(Rules, EachBadExampleHasOneFinding) {
  for (const auto& rule : rules::all())
    if (!rule.bad.empty()) {
      for (const auto& d : compile_text(rule.bad).program.diagnostics)
        EXPECT_EQ(d.rule, &rule) << rule.id << ": " << d.rule->id << ": " << in_english(d.message);
    }
}

TEST(Rules, EachGoodExampleIsFine) {
  for (const auto& rule : rules::all())
    for (const auto& d : compile_text(rule.good).program.diagnostics)
      if (!rule.good.empty())
        ADD_FAILURE() << rule.id << ": " << d.rule->id << ": " << in_english(d.message);
}

TEST(Rules, RowsAreWritten) {
  for (const auto& rule : rules::all()) {
    EXPECT_FALSE(rule.summary.empty()) << rule.id;
    EXPECT_FALSE(rule.explanation.empty()) << rule.id;
    EXPECT_EQ(rules::find(rule.id), &rule);
  }
}

std::string fixed(std::string text) {
  for (int round = 0; round < 8; ++round) {
    auto next = apply_fixes(text, findings_by_file(compile_text(text).program).front());
    if (next.count == 0)
      break;
    text = std::move(next.text);
  }
  return text;
}

TEST(Habits, OfOtherLanguagesAreRewritten) {
  const std::map<std::string, std::string> habits = {
      {"x = yaw\nif x == 9 && x != 3 then print x\n",
       "x = yaw\nif x = 9 and x != 3 then print x\n"},
      {"do\n  delay 1s\nloop\n", "loop\n  delay 1s\nend loop\n"},
      {"let x = 5 // five\nprint x\n", "x = 5 ' five\nprint x\n"},
      {"# start\nvar x = 5\nprint x\n", "' start\nx = 5\nprint x\n"},
      {"if yaw > 1 then\n  print 1\nelif yaw > 0 then\n  print 2\nelse if yaw then\n  print "
       "3\nendif\n",
       "if yaw > 1 then\n  print 1\nelseif yaw > 0 then\n  print 2\nelseif yaw then\n  print "
       "3\nend if\n"},
      {"while yaw > 9\n  delay 9\n  if speed then break\nwend\n",
       "while yaw > 9\n  delay 9\n  if speed then exit\nend while\n"},
      {"sub a\n  print 1\nend sub\ncall a\n", "sub a\n  print 1\nend sub\na()\n"},
      {"dim a[3]\na[1] = 2\nprint a[1]\n", "array a[3]\na[1] = 2\nprint a[1]\n"},
      {"rem hello\nprint 1\n", "' hello\nprint 1\n"},
      {"x = 1\nswitch (x) {\n  case 1:\n    print 1;\n    break;\n  default:\n    print 2\n}\n",
       "x = 1\nselect x\n  case 1\n    print 1;\n  else\n    print 2\nend select\n"},
      {"do\n  delay 9\nloop until yaw > 9 and speed > 1\n",
       "repeat\n  delay 9\nuntil yaw > 9 and speed > 1\n"},
      {"do until yaw > 9 and speed > 1\n  delay 9\nloop\n",
       "while not (yaw > 9 and speed > 1)\n  delay 9\nend while\n"},
      {"def f(a)\n  return a * 2\nend def\nprint f(3)\n",
       "function f(a)\n  return a * 2\nend function\nprint f(3)\n"},
  };
  for (const auto& [foreign, own] : habits) {
    EXPECT_TRUE(compile_text(foreign).has_errors()) << foreign;
    EXPECT_EQ(fixed(foreign), own);
    EXPECT_FALSE(compile_text(own).has_errors()) << own;
  }
}

} // namespace
} // namespace orb::structured
