#include "cli/ball/judged.h"

#include "base/text/utf8.h"
#include "cli/context/json.h"
#include "protocol/judge/rules.h"
#include "protocol/judge/texts.h"
#include "testing/verdicts/render.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::cli {
namespace {

namespace said = protocol::texts;
using protocol::Mistake;
using protocol::Occurrence;

/// `line 3 (0.120)`
std::string place_text(const Occurrence& place, Numbered numbered, const Say& say) {
  const auto when = place.when.empty() ? "" : fmt::format("({})", place.when);
  if (numbered == Numbered::Nothing || place.number == 0)
    return place.when.empty() ? "?" : place.when;
  const auto number =
      say(numbered == Numbered::Lines ? said::AtLine(place.number) : said::AtFrame(place.number));
  return when.empty() ? number : number + " " + when;
}

std::string places_text(const Mistake& mistake, Numbered numbered, const Say& say) {
  std::string all;
  for (const auto& place : mistake.places)
    all += (all.empty() ? "" : ", ") + place_text(place, numbered, say);
  if (mistake.count == 1)
    return say(said::Once(all));
  return say(said::Often(mistake.count, mistake.count > mistake.places.size() ? all + ", …" : all));
}

/// The diagnostics that renderers of findings count.
std::vector<FileFindings> as_findings(const JudgedLog& log) {
  FileFindings all;
  for (const auto& conversation : log.conversations)
    for (const auto& mistake : conversation.judgement.mistakes) {
      Diagnostic one;
      one.rule = mistake.rule;
      one.severity = mistake.severity;
      all.diagnostics.push_back(std::move(one));
    }
  return {all};
}

std::string heard_name(const JudgedLog& log, const Judged& conversation) {
  return conversation.robot.empty() ? log.name : log.name + ", " + conversation.robot;
}

/// Adds one test for each rule, passed if the conversation kept it.
void add_tests(testing::Results& results, const JudgedLog& log, const Judged& conversation) {
  for (const auto& rule : protocol::rules::all()) {
    testing::CaseResult one;
    for (const auto& mistake : conversation.judgement.mistakes)
      if (mistake.rule == &rule && mistake.severity != Severity::Info) {
        one.verdict = testing::Verdict::Failed;
        one.misses.push_back({static_cast<std::uint32_t>(mistake.places.front().number),
                              std::string(rule.id), mistake.message,
                              places_text(mistake, log.numbered, &in_english)});
      }
    testing::GroupResult group;
    group.file = log.name;
    group.test = rule.id;
    group.program = conversation.robot.empty() ? "client" : conversation.robot;
    group.count = 1;
    group.cases.push_back(std::move(one));
    results.groups.push_back(std::move(group));
    ++results.cases;
  }
}

} // namespace

bool JudgedLog::is_clean() const {
  return std::ranges::all_of(conversations,
                             [](const Judged& one) { return one.judgement.is_clean(); });
}

std::string judged_text(const JudgedLog& log, Style style, const Say& say) {
  std::string out;
  for (const auto& conversation : log.conversations) {
    const auto& judgement = conversation.judgement;
    out += say(said::Heard(heard_name(log, conversation), judgement.commands, judgement.answers)) +
           "\n";
    for (const auto& mistake : judgement.mistakes) {
      const auto kind =
          fmt::format("{}[{}]", say(severity_word(mistake.severity)), mistake.rule->id);
      out += fmt::format("{}: {}\n", style.paint(role_of(mistake.severity), kind),
                         to_printable(say(mistake.message)));
      out += fmt::format("  {}\n", places_text(mistake, log.numbered, say));
      out += fmt::format("    {}\n", style.paint(Role::Dim, to_hex(mistake.places.front().raw)));
      if (!mistake.help.empty())
        out += fmt::format("  {}: {}\n", style.paint(Role::Good, say(said::Help())),
                           to_printable(say(mistake.help)));
    }
  }
  return out + render_summary(as_findings(log), say);
}

std::string judged_json(const JudgedLog& log, const Say& say) {
  Json json;
  json["schema"] = "orb.judge/1";
  json["file"] = log.name;
  json["conversations"] = Json::array();
  for (const auto& conversation : log.conversations) {
    Json one;
    if (!conversation.robot.empty())
      one["robot"] = conversation.robot;
    one["packets"] = conversation.packets == spec::Packets::V1 ? "v1" : "v2";
    one["commands"] = conversation.judgement.commands;
    one["answers"] = conversation.judgement.answers;
    one["findings"] = Json::array();
    for (const auto& mistake : conversation.judgement.mistakes) {
      Json finding;
      finding["rule"] = mistake.rule->id;
      finding["severity"] = to_string(mistake.severity);
      finding["message"] = say(mistake.message);
      if (!mistake.help.empty())
        finding["help"] = say(mistake.help);
      finding["count"] = mistake.count;
      finding["places"] = Json::array();
      for (const auto& place : mistake.places) {
        Json at;
        if (!place.when.empty())
          at["at"] = place.when;
        if (place.number != 0 && log.numbered != Numbered::Nothing)
          at[log.numbered == Numbered::Lines ? "line" : "frame"] = place.number;
        at["raw"] = to_hex(place.raw);
        finding["places"].push_back(std::move(at));
      }
      one["findings"].push_back(std::move(finding));
    }
    json["conversations"].push_back(std::move(one));
  }
  const auto counts = count(as_findings(log));
  json["summary"] = {
      {"errors", counts.errors}, {"warnings", counts.warnings}, {"notes", counts.infos}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string judged_junit(const JudgedLog& log) {
  testing::Results results;
  for (const auto& conversation : log.conversations)
    add_tests(results, log, conversation);
  return testing::render_junit(results);
}

} // namespace orb::cli
