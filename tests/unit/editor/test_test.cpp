// Requests of an editor about a test file.

#include "tests/unit/editor/client.h"

#include <gtest/gtest.h>

namespace orb::editor {
namespace {

struct TestSession : LspClient {
  explicit TestSession(const std::string& text) : LspClient("utf-8") {
    document = "file:///robot/corner.test";
    open("10 print \"x\"\n", "file:///robot/corner.bas");
    open(text, document);
  }
};

TEST(Tests, AreCheckedBesideTheirPrograms) {
  TestSession wrong("expect prnt \"x\"\nexpect lap = 3 at end\n");
  EXPECT_EQ(wrong.codes(), (std::vector<std::string>{"test-word", "test-variable"}));
  TestSession good("expect print \"x\"\nexpect A = 3 at end\n");
  EXPECT_TRUE(good.codes().empty());
}

TEST(Tests, HoverSaysWhatAWordExpects) {
  TestSession session("at 1s shake\nexpect near 60,0 by 12cm at end\n");
  EXPECT_NE(session.hover(1, 9).find("within that distance"), std::string::npos);
  EXPECT_NE(session.hover(1, 2).find("what must happen"), std::string::npos);
  EXPECT_NE(session.hover(0, 8).find("somebody shakes the ball"), std::string::npos);
}

TEST(Tests, CompletionFitsThePlace) {
  TestSession session("\nexpect \nexpect color \nat 1s \nexpect moving \n");
  EXPECT_TRUE(session.suggests(0, 0, "never"));
  EXPECT_TRUE(session.suggests(0, 0, "wall"));
  EXPECT_TRUE(session.suggests(1, 7, "beyond"));
  EXPECT_FALSE(session.suggests(1, 7, "wall"));
  EXPECT_TRUE(session.suggests(2, 13, "purple"));
  EXPECT_TRUE(session.suggests(3, 6, "toss"));
  EXPECT_TRUE(session.suggests(4, 14, "within"));
}

} // namespace
} // namespace orb::editor
