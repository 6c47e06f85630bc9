// A structured program as rows, from which the page makes blocks.

#include "editor/languages/structured/block_rows.h"

#include "spec/basic.h"
#include "structured/layout/format.h"
#include "structured/text/structured_words.h"
#include "tests/unit/structured/random_structured.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

Json rows_of(std::string_view text) {
  return Json::parse(structured_tree(text)).at("rows");
}

/// Returns each row as its kind, its text and its members other than items.
std::string brief(const Json& row) {
  auto text = std::to_string(row.at("line").get<int>()) + " " + row.at("kind").get<std::string>();
  for (const auto* key : {"block", "word", "name", "sign", "after_blank", "last", "indent", "text",
                          "lines", "comment", "then", "else"})
    if (row.contains(key))
      text += " " + std::string(key) + "=" + row.at(key).dump();
  return text;
}

std::vector<std::string> brief_rows(std::string_view text) {
  std::vector<std::string> all;
  for (const auto& row : rows_of(text))
    all.push_back(brief(row));
  return all;
}

/// Returns an expression as nested lists.
std::string listed(const Json& node) {
  auto text = std::string(node.value("groups", std::size_t{0}), '(') +
              node.at("kind").get<std::string>() + ":" + node.at("text").get<std::string>();
  for (const auto& operand : node.value("operands", Json::array()))
    text += " [" + listed(operand) + "]";
  return text;
}

std::string value_of(std::string_view expression) {
  const auto rows = rows_of("x = " + std::string(expression) + "\n");
  return listed(rows.at(0).at("items").at(1).at("value"));
}

using Rows = std::vector<std::string>;

TEST(BlockRows, HasARowForEachLineAsFmtWritesIt) {
  EXPECT_EQ(
      brief_rows("' head\n\n\n SIDE=1200  ' how far\ngoroll 0,80,1\nagain:\nGoto again\n"),
      (Rows{R"(1 comment text="' head")",
            R"(4 assign sign="=" after_blank=true text="SIDE = 1200" comment="' how far")",
            R"(5 robot word="goroll" text="goroll 0, 80, 1")",
            R"(6 label name="again" text="again:")", R"(7 goto name="again" text="goto again")"}));
}

TEST(BlockRows, SaysWhatOpensAndEndsABlock) {
  EXPECT_EQ(
      brief_rows("if dshake then\nend\nelse\nend\nend if\nfor n=1 to 3\nnext n\n"),
      (Rows{R"(1 if block="open" text="if dshake then")", R"(2 robot word="end" text="end")",
            R"(3 else block="part" text="else")", R"(4 robot word="end" text="end")",
            R"(5 end if block="end" text="end if")", R"(6 for block="open" text="for n = 1 to 3")",
            R"(7 next block="end" text="next n")"}));
}

TEST(BlockRows, PutsTheBranchesOfAnIfOnOneLineIntoItsRow) {
  const auto rows = rows_of("if a then exit else b += 1\n' below\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("then").at("kind"), "exit");
  EXPECT_EQ(rows[0].at("else").at("sign"), "+=");
  EXPECT_FALSE(rows[0].contains("block"));
  EXPECT_EQ(rows[1].at("kind"), "comment");
}

TEST(BlockRows, KeepsTheLinesOfAStatementThatGoesOn) {
  EXPECT_EQ(
      brief_rows("data 1, ' one\n 2,\n3 ' three\n"),
      Rows{
          R"(1 robot word="data" last=3 indent=2 text="data 1, 2, 3" lines=["data 1, ' one","2,","3"] comment="' three")"});
}

TEST(BlockRows, KeepsWhatIsNoStatementAsItIs) {
  EXPECT_EQ(
      brief_rows("delay 1s\n  goroll  0  80\n\n' note\n\tend  while ' x\nwhile a\ndelay 2s\n"),
      (Rows{R"(1 robot word="delay" text="delay 1s")", R"(2 text lines=["  goroll  0  80"])",
            R"(4 comment after_blank=true text="' note")", R"(5 text lines=["\tend  while ' x"])",
            R"(6 text lines=["while a"])", R"(7 robot word="delay" text="delay 2s")"}));
}

TEST(BlockRows, HasTheOperandsOfExpressionsAndTheirGroups) {
  EXPECT_EQ(value_of("a + 2 * -b"),
            "operation:+ [name:a] [operation:* [number:2] [negate:- [name:b]]]");
  EXPECT_EQ(value_of("((a) + (b)) - (1s)"),
            "operation:- [(operation:+ [(name:a] [(name:b]] [(number:1s]");
  EXPECT_EQ(value_of("f((a), b) + abs((c)) + l[(2)]"),
            "operation:+ [operation:+ [call:f [(name:a] [name:b]] [builtin:abs [(name:c]]] "
            "[element:l [(number:2]]");
  EXPECT_EQ(value_of("not (a != 1 and b <= min(2, Speed)) or c"),
            "logic:or [not:not [(logic:and [relation:!= [name:a] [number:1]] [relation:<= [name:b] "
            "[builtin:min [number:2] [sensor:speed]]]]] [name:c]");
}

TEST(BlockRows, LeavesWhatIsTooLargeAsText) {
  std::string sum = "x = 1";
  for (int n = 0; n < 100'000; ++n)
    sum += " + 1";
  std::string nest;
  for (int n = 0; n < 70; ++n)
    nest += "loop\n";
  for (int n = 0; n < 70; ++n)
    nest += "end loop\n";
  EXPECT_EQ(rows_of(sum).at(0).at("kind"), "text");
  const auto rows = rows_of(nest);
  EXPECT_EQ(rows.at(63).at("kind"), "loop");
  EXPECT_EQ(rows.at(64).at("kind"), "text");
}

/// Returns the rows as text, to which the blocks must lead back.
std::string written(const Json& rows) {
  std::string out;
  int level = 0;
  for (const auto& row : rows) {
    const auto block = row.value("block", "");
    const int width = row.at("kind") == "select" || row.at("kind") == "end select" ? 2 : 1;
    if (block == "end")
      level -= width;
    const int own = level - (block == "part" ? 1 : 0);
    out += row.value("after_blank", false) ? "\n" : "";
    const auto& lines = row.contains("lines") ? row.at("lines") : Json::array({row.at("text")});
    for (std::size_t n = 0; n < lines.size(); ++n) {
      if (row.at("kind") == "text") {
        out += lines[n].get<std::string>() + "\n";
        continue;
      }
      const bool alone = row.at("kind") == "comment";
      const int more = n > 0 || alone ? row.value("indent", 0) : 0;
      out += std::string(static_cast<std::size_t>(2 * (own + more)), ' ');
      out += lines[n].get<std::string>();
      if (n + 1 == lines.size() && row.contains("comment"))
        out += " " + row.at("comment").get<std::string>();
      out += "\n";
    }
    if (block == "open")
      level += width;
  }
  return out;
}

TEST(BlockRows, HasAllThatFmtWrites) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto text = structured::format(testing::RandomStructured(seed).write());
    ASSERT_EQ(written(rows_of(text)), text) << "seed " << seed;
  }
}

TEST(BlockRows, TakesAnyBytes) {
  Random random{1};
  for (int n = 0; n < 2000; ++n) {
    std::string text;
    for (auto size = random.below(60); size > 0; --size)
      text += "\n\r\t\"'(),:;#x5= if\x80"[random.below(19)];
    ASSERT_NO_THROW(rows_of(text)) << text;
  }
}

TEST(StructuredVocabulary, HasTheRowsOfTheTables) {
  const auto words = Json::parse(structured_vocabulary());
  EXPECT_EQ(words.at("statements").size(), spec::statements.size());
  EXPECT_EQ(words.at("sensors").size(), spec::variables.size());
  for (const auto& row : words.at("statements"))
    if (row.at("word") == "goroll") {
      EXPECT_EQ(row.at("parameters").at(0),
                Json({{"name", "heading"}, {"least", 0}, {"greatest", 359}, {"unit", "deg"}}));
      EXPECT_EQ(row.at("required"), 2);
    }
  EXPECT_EQ(words.at("colours").size(), structured::colour_names().size());
}

} // namespace
} // namespace orb::editor
