// The layout of test files and stimulus scripts.

#include "testing/text/layout.h"

#include "base/random.h"
#include "base/text/text.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::testing {
namespace {

std::string signs_of(std::string_view text) {
  std::string out;
  std::copy_if(text.begin(), text.end(), std::back_inserter(out),
               [](char c) { return !is_blank(c) && c != '\n' && c != '\r'; });
  return out;
}

TEST(Layout, MovesNothingButBlanks) {
  constexpr std::string_view pieces[] = {
      "test ", "\"a  b\"", "\"open", "# c",   "\n",  "\r\n", "\r", "  ", "\t",      "/",
      "/x y/", "\\/",      "expect", "at 2s", "0,0", "#",    "\"", "é",  "#ff0000 "};
  Random random{1};
  for (int run = 0; run < 20000; ++run) {
    std::string text;
    for (auto n = random.below(12); n > 0; --n)
      text += pieces[random.below(std::size(pieces))];
    const auto once = layout(text);
    ASSERT_EQ(signs_of(once), signs_of(text)) << text;
    ASSERT_EQ(layout(once), once) << text;
  }
}

} // namespace
} // namespace orb::testing
