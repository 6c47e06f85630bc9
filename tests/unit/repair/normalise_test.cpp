#include "repair/normalise.h"

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {
namespace {

/// Lines around an example, with the names that it uses.
std::string_view around(Language language) {
  switch (language) {
  case Language::Basic: return "\n20 start: A = 1\n30 B = 2\n40 print A B N\n";
  case Language::Structured:
    return "\nspeed = 0\nis_record = 0\ndirection = 0\nstate = speed\narray values[4]\n"
           "for i = 1 to 3\nnext i\nsub show(time)\nend sub\n";
  case Language::Macro:
  case Language::Test: break;
  }
  return "\n";
}

Dialect dialect_of(Language language) {
  Dialect dialect;
  dialect.language = language;
  dialect.words = {"print", "if",   "then", "else", "for",    "to",   "goto", "next", "delay",
                   "RGB",   "LEDC", "data", "abs",  "goroll", "toss", "sub",  "and"};
  return dialect;
}

Language first_of(std::uint8_t languages) {
  for (const auto one : {Language::Basic, Language::Structured, Language::Macro, Language::Test})
    if ((languages & in::bit(one)) != 0)
      return one;
  return Language::Basic;
}

/// Applies one rewrite to an example.
std::string read(const Rewrite& row) {
  const auto language = first_of(row.languages);
  const auto dialect = dialect_of(language);
  const Source source({}, std::string(row.before) + std::string(around(language)));
  const Scenery scenery(source, language);
  auto line = look_at(source, dialect, scenery, 1);
  row.apply(line);
  return join(line);
}

TEST(Normalise, EachRewriteDoesWhatItsExampleShows) {
  for (const auto& row : rewrites())
    EXPECT_EQ(read(row), row.after) << row.before;
}

TEST(Normalise, LeavesRightLinesAlone) {
  for (const auto& row : rewrites()) {
    auto again = row;
    again.before = row.after;
    EXPECT_EQ(read(again), row.after);
  }
}

} // namespace
} // namespace orb::repair
