#include "base/catalogue.h"
#include "base/texts.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

const auto german = *Catalogue::read(R"({
  "write `{line}`; {why}": "{why}: schreib `{line}`",
  "remove it": "entfern es",
  "{n} errors": "{n} Fehler",
  "the ball stops": "der Ball hält an"
})");

TEST(Catalogue, FillsTheHolesOfATranslation) {
  EXPECT_EQ(german.say(texts::Errors(3)), "3 Fehler");
  EXPECT_EQ(german.say(texts::WriteBecause("end", texts::RemoveIt())), "entfern es: schreib `end`");
}

TEST(Catalogue, LeavesWordsInHolesAsTheyAre) {
  EXPECT_EQ(german.say(texts::WriteBecause("remove it", texts::RemoveIt())),
            "entfern es: schreib `remove it`");
  EXPECT_EQ(german.say(texts::WriteBecause("{why}", texts::RemoveIt())),
            "entfern es: schreib `{why}`");
}

TEST(Catalogue, SaysInEnglishWhatItDoesNotHave) {
  EXPECT_EQ(german.say(texts::WriteLike("end")), "write it like `end`");
  EXPECT_EQ(german.say(texts::WriteBecause("end", texts::RemoveLine())),
            "write `end`; remove the line"); // not partly in German
  EXPECT_EQ(german.say({}), "");
}

TEST(Catalogue, LooksUpWordsAsAWhole) {
  EXPECT_EQ(german.say(Message::as_is("the ball stops")), "der Ball hält an");
  EXPECT_EQ(german.say(Message::as_is("the ball")), "the ball");
}

TEST(Catalogue, MarksEachTextInThePseudoLocale) {
  const auto marked = *Catalogue::marked(R"({"remove it": "", "write `{line}`; {why}": ""})");
  EXPECT_EQ(marked.say(texts::WriteBecause("end", texts::RemoveIt())),
            "⟦write `end`; ⟦remove it⟧⟧");
}

TEST(Catalogue, IsReadFromAnObjectOfTextsOnly) {
  EXPECT_FALSE(Catalogue::read("not JSON"));
  EXPECT_FALSE(Catalogue::read("[]"));
  EXPECT_FALSE(Catalogue::read(R"({"a": 1})"));
}

TEST(Message, IsComparedByItsTextAndWhatFillsIt) {
  EXPECT_EQ(texts::Write("a"), texts::Write("a"));
  EXPECT_NE(texts::Write("a"), texts::Write("b"));
  EXPECT_NE(texts::Write("a"), texts::Add("a"));
  EXPECT_TRUE(texts::Write("a").is(texts::Write));
}

TEST(Message, FillsAHoleThatIsNamedTwice) {
  static constexpr Row<Hole::Code, Hole::Code> twice{"`{a}`, `{b}`, `{a}`"};
  EXPECT_EQ(in_english(twice("x", 1)), "`x`, `1`, `x`");
}

} // namespace
} // namespace orb
