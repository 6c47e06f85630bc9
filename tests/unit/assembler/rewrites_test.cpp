#include "assembler/text/rewrites.h"

#include <gtest/gtest.h>
#include <string>

namespace orb::assembler {
namespace {

TEST(Rewrites, DoWhatTheirExamplesSay) {
  for (const auto& one : rewrites()) {
    auto line = repair::tokens_of(one.before, repair::Language::Macro);
    one.apply(line);
    EXPECT_EQ(repair::join(line), one.after) << one.does;
  }
}

TEST(Rewrites, TakeLinesOfAnyOneToken) {
  for (const std::string text : {".macro", "id", "(", "$", "&", "-", "\"\"", "5", "await", "def"})
    for (const auto& one : rewrites()) {
      auto line = repair::tokens_of(text, repair::Language::Macro);
      ASSERT_FALSE(line.empty()) << text;
      one.apply(line);
      EXPECT_LE(line.size(), 2U) << text;
    }
}

} // namespace
} // namespace orb::assembler
