#include "base/text/shell.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(Shell, WordsAreQuotedAsEveryShellReadsThem) {
  EXPECT_EQ(shell_word("my/square.bas"), "my/square.bas");
  EXPECT_EQ(shell_word("at 2s shake"), "\"at 2s shake\"");
  EXPECT_EQ(shell_word("it's; here"), "\"it's; here\"");
  EXPECT_EQ(shell_word(""), "\"\"");
}

TEST(Shell, AQuoteInsideIsEscaped) {
  const auto word = shell_word("say \"hi\"");
  EXPECT_TRUE(word == "'say \"hi\"'" || word == "\"say \\\"hi\\\"\"") << word;
}

} // namespace
} // namespace orb
