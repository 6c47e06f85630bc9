// The requirements of the SARIF 2.1.0 schema, spelled out: required properties, their types,
// allowed values, and valid indices.

#include "base/render.h"
#include "base/texts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace orb {
namespace {

using Json = nlohmann::json;

constexpr Rule bad_word{"bad-word", Severity::Error, "a word is bad", "It is.", "", "", 2};
constexpr Rule odd_word{"odd-word", Severity::Info, "a word is odd", "", "", "", 0};

/// Expects that the schema knows every property of `object` (additionalProperties is false
/// throughout the schema).
void expect_only(const Json& object, const std::vector<std::string>& known) {
  ASSERT_TRUE(object.is_object());
  for (const auto& [key, value] : object.items())
    EXPECT_NE(std::find(known.begin(), known.end(), key), known.end()) << key;
}

void expect_message(const Json& message) {
  expect_only(message, {"text", "markdown", "id", "arguments", "properties"});
  EXPECT_TRUE(message.contains("text") && message["text"].is_string());
}

void expect_region(const Json& region) {
  expect_only(region, {"startLine", "startColumn", "endLine", "endColumn"});
  for (const auto& [key, value] : region.items()) {
    EXPECT_TRUE(value.is_number_integer()) << key;
    EXPECT_GE(value.get<int>(), 1) << key;
  }
  EXPECT_LE(region["startLine"], region["endLine"]);
}

void expect_artifact(const Json& location) {
  expect_only(location, {"uri", "uriBaseId", "index", "description", "properties"});
  const auto uri = location["uri"].get<std::string>();
  EXPECT_EQ(uri.find_first_of(" <>\"{}|\\^`"), std::string::npos) << uri;
}

void expect_location(const Json& location) {
  expect_only(location, {"id", "physicalLocation", "logicalLocations", "message", "annotations",
                         "relationships", "properties"});
  expect_artifact(location["physicalLocation"]["artifactLocation"]);
  expect_region(location["physicalLocation"]["region"]);
}

void expect_level(const Json& level) {
  const auto text = level.get<std::string>();
  EXPECT_TRUE(text == "none" || text == "note" || text == "warning" || text == "error") << text;
}

void expect_rule(const Json& rule) {
  expect_only(rule, {"id", "shortDescription", "fullDescription", "defaultConfiguration", "help",
                     "helpUri", "name", "properties"});
  EXPECT_TRUE(rule["id"].is_string());
  EXPECT_TRUE(rule["shortDescription"]["text"].is_string());
  EXPECT_FALSE(rule["fullDescription"]["text"].get<std::string>().empty());
  expect_level(rule["defaultConfiguration"]["level"]);
}

void expect_fix(const Json& fix) {
  expect_only(fix, {"description", "artifactChanges", "properties"});
  expect_message(fix["description"]);
  ASSERT_FALSE(fix["artifactChanges"].empty());
  for (const auto& change : fix["artifactChanges"]) {
    expect_artifact(change["artifactLocation"]);
    ASSERT_FALSE(change["replacements"].empty());
    for (const auto& replacement : change["replacements"]) {
      expect_region(replacement["deletedRegion"]);
      EXPECT_TRUE(replacement["insertedContent"]["text"].is_string());
    }
  }
}

void expect_result(const Json& result, const Json& rules) {
  expect_only(result, {"ruleId", "ruleIndex", "level", "message", "locations", "relatedLocations",
                       "fixes", "partialFingerprints", "properties"});
  expect_message(result["message"]);
  expect_level(result["level"]);
  const auto index = result["ruleIndex"].get<std::size_t>();
  ASSERT_LT(index, rules.size());
  EXPECT_EQ(rules[index]["id"], result["ruleId"]);
  EXPECT_EQ(result["locations"].size(), 1U);
  expect_location(result["locations"][0]);
  if (result.contains("relatedLocations"))
    for (const auto& location : result["relatedLocations"])
      expect_location(location);
  if (result.contains("fixes"))
    for (const auto& fix : result["fixes"])
      expect_fix(fix);
}

/// The schema's requirements for a whole log.
void expect_valid(const Json& log) {
  expect_only(log, {"$schema", "version", "runs", "inlineExternalProperties", "properties"});
  EXPECT_EQ(log["version"], "2.1.0");
  ASSERT_TRUE(log["runs"].is_array());
  for (const auto& run : log["runs"]) {
    expect_only(run, {"tool", "results", "columnKind", "artifacts", "invocations", "properties"});
    EXPECT_TRUE(run["columnKind"] == "unicodeCodePoints" || run["columnKind"] == "utf16CodeUnits");
    const auto& driver = run["tool"]["driver"];
    expect_only(driver, {"name", "version", "semanticVersion", "informationUri", "rules"});
    EXPECT_FALSE(driver["name"].get<std::string>().empty());
    for (const auto& rule : driver["rules"])
      expect_rule(rule);
    for (const auto& result : run["results"])
      expect_result(result, driver["rules"]);
  }
}

FileFindings findings(const Source& source) {
  FileFindings file;
  file.source = &source;
  auto first = finding(bad_word, {6, 9}, Message::as_is("`bad` is bad"), texts::Write("good"));
  first.notes.push_back({{0, 2}, Message::as_is("the line")});
  first.fix = Fix{texts::Write("good"), {{{6, 9}, "good"}, {{9, 9}, "!"}}, Safety::Safe};
  first.basic_line = 10;
  file.diagnostics.push_back(first);
  file.diagnostics.push_back(finding(odd_word, {12, 12}, Message::as_is("byte \xFF is odd")));
  file.diagnostics.push_back(finding(bad_word, {6, 9}, Message::as_is("again")));
  return file;
}

TEST(Sarif, IsAsTheSchemaAsks) {
  const Source source("a b<é>.bas", "10 \xC3\xA9 bad\n\xFF\xFF\n");
  const auto log = Json::parse(render_sarif({findings(source)}));
  expect_valid(log);
  const auto& results = log["runs"][0]["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(log["runs"][0]["tool"]["driver"]["rules"].size(), 2U);
  EXPECT_EQ(results[0]["level"], "error");
  EXPECT_EQ(results[1]["level"], "note");
  // Columns count code points: the two bytes of the letter before are one.
  EXPECT_EQ(results[0]["locations"][0]["physicalLocation"]["region"]["startColumn"], 6);
  EXPECT_EQ(results[1]["locations"][0]["physicalLocation"]["region"]["startColumn"], 3);
  EXPECT_EQ(results[1]["message"]["text"], "byte \xEF\xBF\xBD is odd");
  EXPECT_EQ(results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "a%20b%3C%C3%A9%3E.bas");
}

std::vector<std::string> fingerprints(std::string text, Span span) {
  const Source source("a.bas", std::move(text));
  FileFindings file{&source,
                    {finding(bad_word, span, Message::as_is("bad")),
                     finding(bad_word, span, Message::as_is("bad")),
                     finding(odd_word, span, Message::as_is("odd"))},
                    {}};
  std::vector<std::string> prints;
  const auto log = Json::parse(render_sarif({file}));
  for (const auto& result : log["runs"][0]["results"])
    prints.push_back(result["partialFingerprints"]["primaryLocationLineHash"]);
  return prints;
}

TEST(Sarif, AFingerprintOutlivesTheLinesAbove) {
  const auto before = fingerprints("10 bad\n", {3, 6});
  EXPECT_EQ(before, fingerprints("5 end\n\n  10 bad\n", {12, 15}));
  EXPECT_EQ(std::set(before.begin(), before.end()).size(), 3U);
  EXPECT_NE(before, fingerprints("10 worse\n", {3, 6}));
}

TEST(Sarif, ARuleSaysWhereItIsExplained) {
  const Source source("a.bas", "10 bad\n");
  const auto log = Json::parse(render_sarif(
      {findings(source)}, [](const Rule& rule) { return "file:///" + std::string(rule.id); }));
  const auto& rules = log["runs"][0]["tool"]["driver"]["rules"];
  EXPECT_EQ(rules[0]["helpUri"], "file:///" + std::string(bad_word.id));
}

TEST(Sarif, WithoutFindingsIsValidToo) {
  const Source source("fine.bas", "10 end\n");
  FileFindings file;
  file.source = &source;
  expect_valid(Json::parse(render_sarif({file})));
}

} // namespace
} // namespace orb
