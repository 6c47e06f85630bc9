// JUnit XML as CI servers read it. These checks restate the two published schemas (Ant's reports,
// Jenkins' junit plugin) in our words.

#include "base/text/utf8.h"
#include "testing/verdicts/render.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>
#include <regex>
#include <set>

namespace orb::testing {
namespace {

constexpr std::string_view nasty =
    "a\x1b[31m\x07 <b> \"c\" 'd' & ]]>\ttab\r\nnext \xff\xef\xbf\xbe é";

GroupResult group(std::string test, Verdict verdict, std::uint64_t cases) {
  GroupResult made;
  made.file = std::string(nasty) + ".test";
  made.test = std::move(test);
  made.program = std::string(nasty) + ".bas";
  made.count = cases;
  for (std::uint64_t i = 0; i < cases; ++i) {
    auto& one = made.cases.emplace_back();
    one.seed = i + 1;
    one.verdict = i == 0 ? verdict : Verdict::Passed;
    one.lasted = 1234567us;
    if (one.verdict == Verdict::Failed)
      one.misses.push_back(
          {1, std::string(nasty), Message::as_is(std::string(nasty)), std::string(nasty)});
    if (one.verdict == Verdict::Error)
      one.problem = std::string(nasty);
  }
  return made;
}

Results results() {
  Results made;
  for (auto& one : {group(std::string(nasty), Verdict::Failed, 3), group("", Verdict::Error, 1),
                    group("passes", Verdict::Passed, 2)})
    made.groups.push_back(one);
  made.groups.push_back(group("of another file", Verdict::Passed, 1));
  made.groups.back().file = "other.test";
  return made;
}

struct Attribute {
  std::string_view element;
  std::string_view name;
  std::string_view type; ///< an ECMAScript pattern of the whole value
};

// The attributes of an element: all are required, no others allowed.
constexpr std::string_view whole = "[0-9]+";
constexpr std::string_view decimal = "[0-9]+\\.[0-9]+";
constexpr std::string_view anything = "[^]*";
constexpr std::string_view something = "[^]+";
constexpr auto attributes = std::to_array<Attribute>({
    {"testsuite", "name", something},
    {"testsuite", "package", something},
    {"testsuite", "id", whole},
    // A date and time without a time zone.
    {"testsuite", "timestamp", "[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}"},
    {"testsuite", "hostname", something},
    {"testsuite", "tests", whole},
    {"testsuite", "failures", whole},
    {"testsuite", "errors", whole},
    {"testsuite", "time", decimal},
    {"testcase", "classname", something},
    {"testcase", "name", anything},
    {"testcase", "time", decimal},
    {"failure", "message", anything},
    {"failure", "type", something},
    {"error", "message", anything},
    {"error", "type", something},
});

void check_attributes(const pugi::xml_node& node) {
  std::set<std::string> wanted;
  for (const auto& row : attributes) {
    if (row.element != node.name())
      continue;
    wanted.emplace(row.name);
    const auto found = node.attribute(std::string(row.name).c_str());
    ASSERT_TRUE(found) << node.name() << " " << row.name;
    EXPECT_TRUE(std::regex_match(found.value(), std::regex(std::string(row.type))))
        << row.name << "=" << found.value();
  }
  for (const auto& one : node.attributes())
    EXPECT_EQ(wanted.erase(one.name()), 1U) << "twice, or not known: " << one.name();
}

std::string names(const pugi::xml_node& node) {
  std::string out;
  for (const auto& child : node.children())
    out += fmt::format("{} ", child.type() == pugi::node_element ? child.name() : "text");
  return out;
}

/// A suite has properties, cases and output, in this order.
void check_suite(const pugi::xml_node& suite, int number) {
  check_attributes(suite);
  EXPECT_EQ(suite.attribute("id").as_int(-1), number);
  EXPECT_TRUE(
      std::regex_match(names(suite), std::regex("properties (testcase )*system-out system-err ")));
  int tests = 0;
  int failures = 0;
  int errors = 0;
  for (const auto& one : suite.children("testcase")) {
    check_attributes(one);
    // At most one of failure and error.
    EXPECT_TRUE(std::regex_match(names(one), std::regex("(failure |error )?"))) << names(one);
    for (const auto& child : one.children()) {
      check_attributes(child);
      EXPECT_TRUE(std::regex_match(names(child), std::regex("(text )?")));
    }
    ++tests;
    failures += one.child("failure") ? 1 : 0;
    errors += one.child("error") ? 1 : 0;
  }
  EXPECT_EQ(suite.attribute("tests").as_int(), tests);
  EXPECT_EQ(suite.attribute("failures").as_int(), failures);
  EXPECT_EQ(suite.attribute("errors").as_int(), errors);
}

TEST(JUnit, HasTheElementsAttributesAndTypesOfTheSchemas) {
  const auto text = render_junit(results());
  pugi::xml_document document;
  const auto parsed = document.load_string(text.c_str(), pugi::parse_full);
  ASSERT_TRUE(parsed) << parsed.description();
  EXPECT_EQ(names(document), "text testsuites "); // the declaration, the root
  const auto root = document.child("testsuites");
  check_attributes(root);
  EXPECT_EQ(names(root), "testsuite testsuite ");
  int number = 0;
  for (const auto& suite : root.children("testsuite"))
    check_suite(suite, number++);
}

TEST(JUnit, HoldsNoCharacterThatXmlForbids) {
  const auto text = render_junit(results());
  EXPECT_EQ(text, to_valid_utf8(text));
  for (const char c : text)
    EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t');
  EXPECT_EQ(text.find("\xef\xbf\xbe"), std::string::npos);
  EXPECT_EQ(text.find("\xef\xbf\xbf"), std::string::npos);
  EXPECT_NE(text.find('\xc3'), std::string::npos); // the rest is there
}

TEST(JUnit, WhatIsEscapedIsReadBack) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(render_junit(results()).c_str()));
  const auto first = document.child("testsuites").child("testsuite").child("testcase");
  const std::string_view read = first.attribute("classname").value();
  EXPECT_TRUE(read.starts_with("a?[31m? <b> \"c\" 'd' & ]]>")) << read;
  EXPECT_NE(read.find("\nnext"), std::string_view::npos) << read;
}

} // namespace
} // namespace orb::testing
