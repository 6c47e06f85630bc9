#include "base/hash.h"
#include "base/path.h"
#include "base/render.h"
#include "base/text/text.h"
#include "base/text/utf8.h"

#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace orb {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto schema = "https://raw.githubusercontent.com/oasis-tcs/sarif-spec/master/Schemata/"
                        "sarif-schema-2.1.0.json";

std::string_view level_of(Severity severity) {
  return severity == Severity::Info ? "note" : to_string(severity);
}

/// The file name as a URI reference, percent-encoded as needed.
std::string uri_of(std::string_view name) {
  if (name == "<stdin>")
    return "stdin";
  constexpr std::string_view plain = "-._~/";
  constexpr std::string_view hex = "0123456789ABCDEF";
  std::string out = has_drive(name) ? "file:///" : name.starts_with('/') ? "file://" : "";
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool keep = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                      plain.find(c) != std::string_view::npos;
    if (keep) {
      out += c;
    } else {
      out += '%';
      out += hex[byte >> 4];
      out += hex[byte & 15];
    }
  }
  return out;
}

/// The column in code points: the log declares that unit.
std::size_t column_of(const Source& source, Position place) {
  return code_points(source.line(place.line).substr(0, place.column - 1)) + 1;
}

Json region_of(const Source& source, Span span) {
  const auto from = source.position(span.begin);
  const auto to = source.position(span.end);
  return {{"startLine", from.line},
          {"startColumn", column_of(source, from)},
          {"endLine", to.line},
          {"endColumn", column_of(source, to)}};
}

Json location_of(const Source& source, Span span) {
  return {{"physicalLocation",
           {{"artifactLocation", {{"uri", uri_of(source.name())}}},
            {"region", region_of(source, span)}}}};
}

Json rule_json(const Rule& rule, const HelpUri& help_uri) {
  Json json;
  json["id"] = rule.id;
  json["shortDescription"] = {{"text", rule.summary}};
  json["fullDescription"] = {{"text", rule.explanation.empty() ? rule.summary : rule.explanation}};
  json["defaultConfiguration"] = {{"level", level_of(rule.severity)}};
  if (auto uri = help_uri ? help_uri(rule) : std::string(); !uri.empty())
    json["helpUri"] = std::move(uri);
  if (rule.robot_error != 0)
    json["properties"] = {{"robotError", rule.robot_error}};
  return json;
}

/// Makes fingerprints that survive changes above a finding: the rule, the text of its line, and a
/// counter for equal ones.
class Fingerprints {
public:
  std::string next(const Source& source, const Diagnostic& diagnostic) {
    const auto line = source.line(source.position(diagnostic.span.begin).line);
    const auto print = hash(fmt::format("{}\n{}", diagnostic.rule->id, trim(line)));
    return fmt::format("{:016x}:{}", print, ++seen_[print]);
  }

private:
  std::map<std::uint64_t, int> seen_;
};

Json sarif_fix(const Source& source, const Fix& fix) {
  Json replacements = Json::array();
  for (const auto& edit : fix.edits) {
    Json replacement;
    replacement["deletedRegion"] = region_of(source, edit.span);
    replacement["insertedContent"] = {{"text", to_valid_utf8(edit.text)}};
    replacements.push_back(std::move(replacement));
  }
  Json change;
  change["artifactLocation"] = {{"uri", uri_of(source.name())}};
  change["replacements"] = std::move(replacements);
  Json json;
  json["description"] = {{"text", to_valid_utf8(in_english(fix.title))}};
  json["artifactChanges"] = Json::array({std::move(change)});
  return json;
}

Json result_json(const Source& source, const Diagnostic& diagnostic, std::size_t rule_index) {
  auto text = to_valid_utf8(in_english(diagnostic.message));
  if (!diagnostic.help.empty())
    text += "; " + to_valid_utf8(in_english(diagnostic.help));
  Json json;
  json["ruleId"] = diagnostic.rule->id;
  json["ruleIndex"] = rule_index;
  json["level"] = level_of(diagnostic.severity);
  json["message"] = {{"text", std::move(text)}};
  json["locations"] = Json::array({location_of(source, diagnostic.span)});
  for (const auto& note : diagnostic.notes) {
    auto related = location_of(source, note.span);
    related["message"] = {{"text", to_valid_utf8(in_english(note.message))}};
    json["relatedLocations"].push_back(std::move(related));
  }
  if (diagnostic.fix && !diagnostic.fix->edits.empty())
    json["fixes"] = Json::array({sarif_fix(source, *diagnostic.fix)});
  if (diagnostic.basic_line)
    json["properties"] = {{"basicLine", *diagnostic.basic_line}};
  return json;
}

} // namespace

std::string render_sarif(const std::vector<FileFindings>& files, const HelpUri& help_uri) {
  std::vector<const Rule*> rules; // in the order of their first finding
  const auto index_of = [&](const Rule* rule) {
    for (std::size_t i = 0; i < rules.size(); ++i)
      if (rules[i] == rule)
        return i;
    rules.push_back(rule);
    return rules.size() - 1;
  };
  Json results = Json::array();
  for (const auto& file : files) {
    Fingerprints fingerprints;
    for (const auto& diagnostic : file.diagnostics) {
      auto result = result_json(*file.source, diagnostic, index_of(diagnostic.rule));
      // GitHub and other code hosts look for this key.
      result["partialFingerprints"] = {
          {"primaryLocationLineHash", fingerprints.next(*file.source, diagnostic)}};
      results.push_back(std::move(result));
    }
  }
  Json rule_rows = Json::array();
  for (const auto* rule : rules)
    rule_rows.push_back(rule_json(*rule, help_uri));
  Json driver;
  driver["name"] = "orb";
  driver["version"] = ORB_VERSION;
  driver["rules"] = std::move(rule_rows);
  Json run;
  run["tool"] = {{"driver", std::move(driver)}};
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = std::move(results);
  Json json;
  json["$schema"] = schema;
  json["version"] = "2.1.0";
  json["runs"] = Json::array({std::move(run)});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace orb
