#include "testing/verdicts/render.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace orb::testing {
namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json case_json(const CaseResult& one, const Say& say) {
  Json json;
  json["seed"] = one.seed;
  json["verdict"] = to_string(one.verdict);
  json["ns"] = one.lasted.count();
  json["lines"] = one.lines;
  if (!one.problem.empty())
    json["problem"] = one.problem;
  for (const auto& miss : one.misses) {
    Json entry;
    entry["line"] = miss.line;
    entry["expected"] = miss.expected;
    entry["seen"] = say(miss.seen);
    if (!miss.where.empty())
      entry["where"] = miss.where;
    json["misses"].push_back(std::move(entry));
  }
  if (!one.again.empty())
    json["again"] = one.again;
  if (one.omitted)
    json["omitted"] = true;
  return json;
}

/// Opens the object of a test, before its cases.
std::string group_head(const GroupResult& group) {
  Json json;
  json["file"] = group.file;
  json["test"] = group.test;
  json["line"] = group.line;
  json["points"] = group.points;
  json["program"] = group.program;
  json["first"] = group.first;
  json["count"] = group.count;
  auto text = dump(json);
  text.pop_back();
  return text + ",\"cases\":[";
}

} // namespace

std::string render_json(const Results& results, const Say& say) {
  const auto totals = totals_of(results);
  std::string out = fmt::format("{{\"schema\":\"orb.test/1\",\n\"cases\":{},\n", results.cases);
  if (!results.shards.empty()) {
    Json shards;
    for (const auto& shard : results.shards)
      shards.push_back({{"index", shard.index}, {"count", shard.count}});
    out += fmt::format("\"shards\":{},\n", dump(shards));
  }
  if (!results.missing.empty())
    out += fmt::format("\"missing\":{},\n", dump(Json(results.missing)));
  out += "\"tests\":[";
  for (std::size_t i = 0; i < results.groups.size(); ++i) {
    const auto& group = results.groups[i];
    out += (i == 0 ? "\n" : ",\n") + group_head(group);
    for (std::size_t k = 0; k < group.cases.size(); ++k)
      out += (k == 0 ? "\n" : ",\n") + dump(case_json(group.cases[k], say));
    out += "]}";
  }
  const Json summary{{"tests", totals.tests},   {"passed", totals.tests_passed},
                     {"points", totals.points}, {"pointsOf", totals.points_of},
                     {"runs", totals.cases},    {"runsFailed", totals.failed}};
  return out + fmt::format("],\n\"summary\":{}}}\n", dump(summary));
}

} // namespace orb::testing
