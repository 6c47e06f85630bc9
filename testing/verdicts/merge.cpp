#include "testing/verdicts/merge.h"

#include "base/refuse.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace orb::testing {
namespace {

using Value = nlohmann::json;

std::optional<Verdict> verdict_called(std::string_view word) {
  for (const auto verdict : {Verdict::Passed, Verdict::Failed, Verdict::Error})
    if (to_string(verdict) == word)
      return verdict;
  return std::nullopt;
}

/// Reads members of objects; remembers if one was missing or had another type.
class ResultsReader {
public:
  bool good() const { return good_; }

  const Value& member(const Value& json, const char* name, Value::value_t kind) {
    static const Value none;
    const auto found = json.is_object() ? json.find(name) : json.end();
    if (!json.is_object() || found == json.end() || found->type() != kind) {
      good_ = false;
      return none;
    }
    return *found;
  }
  std::uint64_t count(const Value& json, const char* name) {
    const auto& found = member(json, name, Value::value_t::number_unsigned);
    return found.is_number_unsigned() ? found.get<std::uint64_t>() : 0;
  }
  std::string text(const Value& json, const char* name) {
    const auto& found = member(json, name, Value::value_t::string);
    return found.is_string() ? found.get<std::string>() : std::string();
  }
  /// Reads a value that must be a text.
  std::string is_text(const Value& json) {
    good_ = good_ && json.is_string();
    return json.is_string() ? json.get<std::string>() : std::string();
  }
  std::string text_or_none(const Value& json, const char* name) {
    return json.is_object() && json.contains(name) ? text(json, name) : std::string();
  }

  Miss miss(const Value& json) {
    return {static_cast<std::uint32_t>(count(json, "line")), text(json, "expected"),
            Message::as_is(text(json, "seen")), text_or_none(json, "where")};
  }

  CaseResult one_case(const Value& json) {
    CaseResult one;
    one.seed = count(json, "seed");
    const auto verdict = verdict_called(text(json, "verdict"));
    good_ = good_ && verdict.has_value();
    one.verdict = verdict.value_or(Verdict::Error);
    one.lasted = Duration{static_cast<Duration::rep>(count(json, "ns"))};
    one.lines = count(json, "lines");
    one.problem = text_or_none(json, "problem");
    one.again = text_or_none(json, "again");
    if (good_ && json.contains("misses"))
      for (const auto& entry : member(json, "misses", Value::value_t::array))
        one.misses.push_back(miss(entry));
    one.omitted = good_ && json.value("omitted", Value()) == true;
    good_ = good_ && (one.verdict != Verdict::Failed || one.omitted || !one.misses.empty());
    return one;
  }

  GroupResult group(const Value& json) {
    GroupResult group;
    group.file = text(json, "file");
    group.test = text(json, "test");
    group.line = static_cast<std::uint32_t>(count(json, "line"));
    group.points = static_cast<int>(count(json, "points"));
    group.program = text(json, "program");
    group.first = count(json, "first");
    group.count = count(json, "count");
    for (const auto& entry : member(json, "cases", Value::value_t::array))
      group.cases.push_back(one_case(entry));
    return group;
  }

private:
  bool good_ = true;
};

bool same_head(const GroupResult& a, const GroupResult& b) {
  return a.file == b.file && a.test == b.test && a.line == b.line && a.points == b.points &&
         a.program == b.program && a.first == b.first && a.count == b.count;
}

/// Names the missing shards, or the number of missing runs if the shards are unknown.
std::string missing(const Results& joined, std::uint64_t runs) {
  const auto there = static_cast<std::uint64_t>(joined.shards.size());
  if (joined.shards.empty())
    return fmt::format("{} runs are missing", runs);
  const auto count = joined.shards.front().count;
  std::string list;
  std::size_t listed = 0;
  constexpr std::size_t most_listed = 10;
  for (std::uint64_t index = 1; index <= count && listed <= most_listed; ++index) {
    const bool known = std::any_of(joined.shards.begin(), joined.shards.end(),
                                   [&](const Shard& shard) { return shard.index == index; });
    if (known)
      continue;
    list += listed == most_listed ? ", …"
                                  : fmt::format("{}{}/{}", list.empty() ? "" : ", ", index, count);
    ++listed;
  }
  return there >= count ? fmt::format("{} runs are missing", runs)
                        : fmt::format("{} runs are missing: those of shard {}", runs, list);
}

} // namespace

tl::expected<Part, Failure> read_results(std::string name, std::string_view text) {
  const auto wrong = [&] {
    return tl::unexpected(Failure{
        ExitCode::File, fmt::format("{} contains no results from `orb test --format json`", name)});
  };
  const auto json = Value::parse(text, nullptr, false);
  if (!json.is_object() || json.value("schema", Value()) != "orb.test/1")
    return wrong();
  ResultsReader reader;
  Results results;
  results.cases = reader.count(json, "cases");
  if (json.contains("shards"))
    for (const auto& shard : reader.member(json, "shards", Value::value_t::array))
      results.shards.push_back({reader.count(shard, "index"), reader.count(shard, "count")});
  for (const auto& group : reader.member(json, "tests", Value::value_t::array))
    results.groups.push_back(reader.group(group));
  if (json.contains("missing"))
    for (const auto& one : reader.member(json, "missing", Value::value_t::array))
      results.missing.push_back(reader.is_text(one));
  if (!reader.good())
    return wrong();
  return Part{std::move(name), std::move(results)};
}

tl::expected<Results, Failure> merge(std::vector<Part> parts) {
  Results joined = std::move(parts.front().results);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    auto& part = parts[i].results;
    if (part.cases != joined.cases || part.groups.size() != joined.groups.size() ||
        !std::equal(part.groups.begin(), part.groups.end(), joined.groups.begin(), same_head))
      return refuse(ExitCode::Usage, fmt::format("{} and {} do not come from the same command",
                                                 parts.front().name, parts[i].name));
    joined.shards.insert(joined.shards.end(), part.shards.begin(), part.shards.end());
    for (std::size_t g = 0; g < part.groups.size(); ++g)
      std::move(part.groups[g].cases.begin(), part.groups[g].cases.end(),
                std::back_inserter(joined.groups[g].cases));
  }
  std::uint64_t there = 0;
  for (auto& group : joined.groups) {
    std::sort(group.cases.begin(), group.cases.end(),
              [](const CaseResult& a, const CaseResult& b) { return a.seed < b.seed; });
    const auto twice = std::adjacent_find(
        group.cases.begin(), group.cases.end(),
        [](const CaseResult& a, const CaseResult& b) { return a.seed == b.seed; });
    if (twice != group.cases.end())
      return refuse(ExitCode::Usage, fmt::format("\"{}\" with {}, seed {}, is in two files",
                                                 group.test, group.program, twice->seed));
    there += group.cases.size();
    keep_first(group);
  }
  if (there != joined.cases)
    return refuse(ExitCode::Usage, missing(joined, joined.cases - std::min(there, joined.cases)));
  joined.shards.clear();
  return joined;
}

} // namespace orb::testing
