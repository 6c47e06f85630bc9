#include "testing/text/plain_line.h"

#include "testing/text/documented_form.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <string>

namespace orb::testing {
namespace {

using repair::Language;

TEST(PlainLine, DoesWhatItsExamplesSay) {
  std::set<std::string_view> seen;
  for (const auto& row : plainers()) {
    EXPECT_TRUE(seen.insert(row.what).second) << row.what;
    auto line = repair::tokens_of(row.before, Language::Test);
    row.apply(line);
    EXPECT_EQ(repair::join(line), row.after) << row.what;
    row.apply(line);
    EXPECT_EQ(repair::join(line), row.after) << row.what << " twice";
  }
}

std::string form_of(std::string_view line) {
  SurroundingText elsewhere;
  elsewhere.has_course = elsewhere.may_have_zones = true;
  const auto all = documented_forms(repair::tokens_of(line, Language::Test), elsewhere);
  return all.empty() ? std::string() : all.front().text;
}

TEST(DocumentedForm, TakesPiecesInAnyOrder) {
  EXPECT_EQ(form_of("expect within 5s near by 12cm 60 0"), "expect near 60,0 by 12cm within 5s");
  EXPECT_EQ(form_of("expect 3 times print \"a\" during 2s to 3s"),
            "expect print \"a\" 3 times during 2s..3s");
  EXPECT_EQ(form_of("push strength 120, heading 90 at 2 s"), "at 2s push 90 120");
  EXPECT_EQ(form_of("expect(color).not.toBe(\"red\").within(3000)"),
            "never color red during 0s..3s");
  EXPECT_EQ(form_of("erwarte richtung 180 ± 10 am ende"), "expect heading 180 by 10 at end");
}

TEST(DocumentedForm, LosesNothing) {
  EXPECT_EQ(form_of("expect color red blue at end"), "");
  EXPECT_EQ(form_of("expect near 60 60 60 60 by 12cm"), "");
  EXPECT_EQ(form_of("expect lines < 30 30"), "");
  EXPECT_EQ(form_of("at 2s push 90 12 0"), "");
  EXPECT_EQ(form_of("seeds 1 20 3"), "");
}

TEST(DocumentedForm, EndsForAnyWords) {
  constexpr auto words = std::to_array<std::string_view>(
      {"expect", "never", "and",   "after", "print", "\"a\"", "near", "5",   "3s",
       "..",     "(",     ")",     "=",     "by",    "x",     "at",   "end", "color",
       "red",    "test",  "push",  "<",     "/",     "~",     "-",    ",",   "12cm",
       "to",     "\xFF",  "reach", "for",   "seeds", "wall",  "'",    "[",   "{"});
  std::mt19937 random(7);
  for (int n = 0; n < 20'000; ++n) {
    std::string line;
    for (auto count = random() % 24; count > 0; --count)
      line += std::string(words[random() % words.size()]) + (random() % 4 == 0 ? "" : " ");
    form_of(line);
  }
}

} // namespace
} // namespace orb::testing
