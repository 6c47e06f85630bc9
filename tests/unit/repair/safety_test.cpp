#include "repair/safety.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {
namespace {

constexpr auto words = std::to_array<std::string_view>(
    {"and",  "data", "delay", "else", "end",  "for", "gosub", "goroll",
     "goto", "if",   "input", "LEDC", "not",  "or",  "print", "return",
     "RGB",  "rnd",  "speed", "step", "then", "to",  "while"});

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

/// Judges with a parser that accepts only `also`, with any blanks.
bool same(Language language, std::string_view said, std::string_view written,
          std::vector<std::string> also = {}, const std::vector<std::string>& names = {}) {
  const auto parses = [&](std::string_view line) {
    return std::any_of(also.begin(), also.end(), [&](const std::string& one) {
      return without_blanks(one) == without_blanks(std::string(line));
    });
  };
  const auto number_of = [](std::string_view) { return std::string("40"); };
  return says_the_same(said, written, {language, words, names, parses, number_of});
}

TEST(Safety, EachRowOfTheTableHasAnExample) {
  for (const auto& row : notations())
    EXPECT_TRUE(same(row.language, row.said, row.written)) << row.name;
}

TEST(Safety, NothingIsInventedLostOrMoved) {
  struct Case {
    std::string_view said;
    std::string_view written;
  };
  for (const auto& [said, written] : std::to_array<Case>({
           {"10 delay 60 60", "10 delay 6060"},
           {"10 delay 2 2s", "10 delay 22s"},
           {"10 delay 2 2s", "10 delay 2000"},
           {"10 goroll 90,0,", "10 goroll 90,0,1"},
           {"10 goroll 90,0", "10 goroll 90,0,1"},
           {"10 A = B = 5", "10 A = B + 5"},
           {"40 return return", "40 end"},
           {"40 return return", "40 return"},
           {"50 return a", "50 end"},
           {"50 return a", "50 return"},
           {"10 print min(1, 2, 3)", "10 print \"min(1, 2, 3)\""},
           {"10 print the end", "10 print \"end\""},
           {"10 print the end", "10 end"},
           {"10 print print \"x\"", "10 print \"x\""},
           {"10 RGB 0 0,255,U", "10 RGB 0,0,255\n11 delay U"},
           {"10 RGB W,0,255 B", "10 RGB W,0,255 * B"},
           {"10 goroll S and 1,0,1", "10 goroll S,1,0,1"},
           {"10 if A and 0 then end", "10 if A ! 0 and 0 ! 0 then end"},
           {"10 if A then end", "10 if A ! 0 then end"},
           {"10 input 3000,T,120", "10 input T,120,3000"},
           {"10 input 3000,T,120", "10 input T,3000,120"},
           {"130 }", "130 end"},
           {"130 }", "130 goto 30"},
           {"10 delay 1.5", "10 delay 1500"},
           {"10 A = 1", "10 A = 2"},
           {"10 A = B - 1", "10 A = B + 1"},
           {"10 A = 2 / B", "10 A = 2, B"},
           {"10 A = B 1", "10 A = B"},
           {"1 10 return", "1 return"},
           {"1 10 return", "110 return"},
           {"10 A = 2 * (B + 1)", "10 A = 2 * B + 1"},
           {"10 A = not (B = 1)", "10 A = not B = 1"},
           {"10 A -= B + 2", "10 A = A - B + 2"},
           {"10 if B >= 2 * C then end", "10 if B > 1 * C then end"},
           {"10 if A = 1 then B = 2: C = 3", "10 if A = 1 then B = 2\n11 C = 3"},
           {"10 print \"A is, B", "10 print \"A is, B\""},
           {"10 print \"A is B", "10 print \"A is B\""},
           {"10 print A ' then B", "10 print A B"},
           {"10 print \"a\" 'b'", "10 print \"a\""},
           {"10 A = N", "10 A = M"},
           {"10 wend", "10 end"},
           {"10 stop", "10 end"},
           {"10 forward 90", "10 goroll 0,90,1"},
       }))
    EXPECT_FALSE(same(Language::Basic, said, written)) << said << " => " << written;
  for (const auto& [said, written] : std::to_array<Case>({
           {".macro wink id40", ".macro wink_id40"},
           {".macro wink id=", ".macro wink id=32"},
           {".macro wink", ".macro wink id=32"},
           {"fade 255 0 40 40 90", "fade 255 0 4040 90"},
           {"rgb 0 08", "rgb 0 0 8"},
       }))
    EXPECT_FALSE(same(Language::Macro, said, written)) << said << " => " << written;
}

TEST(Safety, WhatIsPutInCanStandInOnePlace) {
  constexpr auto basic = Language::Basic;
  EXPECT_FALSE(same(basic, "10 goroll (H + 90 % 360,1,1", "10 goroll (H + 90) % 360,1,1",
                    {"10 goroll (H) + 90 % 360,1,1"}));
  EXPECT_FALSE(same(basic, "10 A = B * C + 1)", "10 A = B * C + 1", {"10 A = B * (C + 1)"}));
  EXPECT_TRUE(same(basic, "10 A = B * C + 1)", "10 A = B * C + 1", {"10 A = (B * C + 1)"}));
  EXPECT_FALSE(same(basic, "10 goroll 9 0,100", "10 goroll 9,0,100", {"10 goroll 90,100"}));
  EXPECT_FALSE(same(basic, "10 goroll H 9,100", "10 goroll H,9,100", {"10 goroll H+9,100"}));
  EXPECT_FALSE(same(basic, "10 goroll 90,0,", "10 goroll 90,0", {"10 goroll 90,0, 1"}));
}

TEST(Safety, AMisspeltWordHasOneNeighbourAndIsNoName) {
  constexpr auto structured = Language::Structured;
  EXPECT_TRUE(same(structured, "pint a", "print a"));
  EXPECT_FALSE(same(structured, "pint a", "print a", {}, {"pint"}));
  EXPECT_FALSE(same(structured, "pint a", "print a", {}, {"paint"}));
  EXPECT_FALSE(same(structured, "goto x", "gosub x"));
  EXPECT_FALSE(same(structured, "print sped", "print step"));
}

TEST(Safety, NamesAreWordsThatSomethingGivesAMeaning) {
  const Source source({}, "count = 1\nsub drive(way, time)\nif a == 2 then b = 1\nfor i = 1 to 3\n"
                          "again:\nprint other\npritn twice\npritn twice\n");
  EXPECT_EQ(defined_names(source, Language::Structured),
            (std::vector<std::string>{"again", "b", "count", "drive", "i", "time", "way"}));
}

} // namespace
} // namespace orb::repair
