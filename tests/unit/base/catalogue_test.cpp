#include "base/catalogue.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace orb {
namespace {

/// The same cases are tried in JavaScript (tests/translations/check.mjs).
nlohmann::json shared() {
  return nlohmann::json::parse(std::ifstream(ORB_TRANSLATION_CASES));
}

TEST(Catalogue, FindsATextByItsKeyAndFillsItsHoles) {
  const auto file = shared();
  const auto german = *Catalogue::read(file.at("texts").dump());
  for (const auto& row : file.at("cases")) {
    const auto english = row.at(0).get<std::string>();
    const auto said = german.find(english);
    if (row.at(1).is_null())
      EXPECT_FALSE(said) << english << " is said " << *said;
    else
      EXPECT_EQ(said, row.at(1).get<std::string>());
    EXPECT_EQ(german.say(english), said.value_or(english));
  }
}

TEST(Catalogue, IsNotLongOverTextsMadeToDeceiveIt) {
  const auto german = *Catalogue::read(shared().at("texts").dump());
  std::string text = "expected ";
  for (int i = 0; i < 5'000; ++i)
    text += "a number, found `a`; ";
  EXPECT_FALSE(german.find(text));
}

TEST(Catalogue, IsReadFromAnObjectOfTextsOnly) {
  EXPECT_FALSE(Catalogue::read("not JSON"));
  EXPECT_FALSE(Catalogue::read("[]"));
  EXPECT_FALSE(Catalogue::read(R"({"a": 1})"));
  EXPECT_EQ(Catalogue::read("{}")->say("as it is"), "as it is");
}

} // namespace
} // namespace orb
