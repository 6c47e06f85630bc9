// Prints what the tables know of the JavaScript API of Sphero Edu: edu.json, which is made into
// edu.js and the page. The engine does not hold it, so that nobody loads it who writes no
// JavaScript.

#include "spec/edu.h"

#include <emscripten/console.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

namespace {

using nlohmann::ordered_json;
namespace spec = orb::spec;

/// The names of the robots of a set, as `--robot` takes them.
ordered_json names_of(spec::V2Robots robots) {
  auto names = ordered_json::array();
  for (const auto& row : spec::robots)
    if ((robots & spec::only(row.robot)) != 0)
      names.push_back(row.name);
  return names;
}

template <class Names, class Value>
std::string_view name_of(const Names& names, Value value) {
  return names[static_cast<std::size_t>(value)];
}

ordered_json operands_of(spec::EduCall call) {
  auto operands = ordered_json::array();
  for (const auto& one : spec::edu_operands)
    if (one.call == call)
      operands.push_back({{"name", one.name},
                          {"type", name_of(spec::edu_types, one.type)},
                          {"least", one.least},
                          {"most", one.most},
                          {"presence", name_of(spec::edu_presences, one.presence)},
                          {"unit", one.unit}});
  return operands;
}

ordered_json words_in(std::string_view text) {
  auto words = ordered_json::array();
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;)
    words.push_back(word);
  return words;
}

ordered_json table() {
  ordered_json functions, events, objects, old, robots;
  for (const auto& row : spec::edu_calls)
    functions.push_back({{"name", row.name},
                         {"group", name_of(spec::edu_groups, row.group)},
                         {"kind", name_of(spec::edu_kinds, row.kind)},
                         {"gives", name_of(spec::edu_gives, row.gives)},
                         {"robots", names_of(row.robots)},
                         {"operands", operands_of(row.call)},
                         {"source", row.source},
                         {"example", row.example},
                         {"summary", row.summary}});
  for (const auto& row : spec::edu_events)
    events.push_back({{"name", row.name},
                      {"says", name_of(spec::edu_gives, row.says)},
                      {"condition", name_of(spec::edu_conditions, row.condition)},
                      {"robots", names_of(row.robots)},
                      {"source", row.source},
                      {"summary", row.summary}});
  for (const auto& row : spec::edu_objects)
    objects.push_back(
        {{"name", row.name}, {"members", words_in(row.members)}, {"source", row.source}});
  for (const auto& row : spec::edu_old_names)
    old[std::string(row.name)] = row.now;
  for (const auto& row : spec::robots)
    robots.push_back({{"name", row.name}, {"title", row.title}});
  return {{"functions", functions},
          {"events", events},
          {"objects", objects},
          {"old_names", old},
          {"robots", robots}};
}

} // namespace

int main() {
  emscripten_console_log(table().dump().c_str());
}
