#include "run/line_map.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace orb::run {
namespace {

using Json = nlohmann::ordered_json;

std::optional<std::uint32_t> number_of(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned())
    return std::nullopt;
  return found->get<std::uint32_t>();
}

std::string text_of(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || !found->is_string() ? std::string() : found->get<std::string>();
}

/// Returns the index of a file and adds it if it is new.
std::uint32_t file_of(LineMap& map, std::string name) {
  const auto found = std::find(map.files.begin(), map.files.end(), name);
  if (found != map.files.end())
    return static_cast<std::uint32_t>(found - map.files.begin());
  map.files.push_back(std::move(name));
  return static_cast<std::uint32_t>(map.files.size()) - 1;
}

Json in_words(const LineMap& map, const WrittenCall& call) {
  Json json;
  json["file"] = map.files[call.file];
  json["line"] = call.line;
  json["column"] = call.column;
  if (!call.sub.empty())
    json["sub"] = call.sub;
  return json;
}

} // namespace

std::string LineMap::words(std::uint32_t robot_line) const {
  const auto found = places.find(robot_line);
  if (found == places.end() || found->second.file >= files.size())
    return {};
  const auto& place = found->second;
  return fmt::format("{}:{}:{}", files[place.file], place.line, place.column);
}

LineMap line_map(const std::string& file, const compiler::Image& image) {
  LineMap map{{file}, {}, Known::Line, {}};
  for (const auto& line : image.lines)
    if (line.number != compiler::none)
      map.places.emplace(line.number, LinePlace{0, line.source_line});
  return map;
}

LineMap line_map(const structured::Compiled& compiled) {
  LineMap map;
  map.known = Known::FileAndColumn;
  const auto& program = compiled.program;
  std::vector<Source> sources;
  for (const auto& file : program.files) {
    map.files.push_back(file.name);
    sources.emplace_back(file.name, program.text.substr(file.begin, file.end - file.begin));
  }
  const auto place_of = [&](std::uint32_t statement) {
    const auto place = structured::place_of(program, program.statements[statement].span);
    const auto at = sources[place.file].position(place.span.begin);
    const auto& routine = compiled.names.routines[compiled.names.routine_of[statement]];
    return LinePlace{place.file, at.line, at.column,
                     routine.symbol == structured::none
                         ? std::string()
                         : std::string(program.name(compiled.names.symbols[routine.symbol].name))};
  };
  for (const auto& line : compiled.robot.lines) {
    auto place = place_of(line.statement);
    for (auto id = line.expansion; id != 0; id = compiled.code.expansions[id].within) {
      const auto call = place_of(compiled.code.expansions[id].call);
      place.calls.insert(place.calls.begin(), {id, call.file, call.line, call.column, call.sub});
    }
    map.places.emplace(line.number, std::move(place));
  }
  const auto& expansions = compiled.code.expansions;
  for (std::size_t i = 1; i < expansions.size(); ++i) {
    const auto& routine = compiled.names.routines[expansions[i].routine];
    map.calls.push_back({std::string(program.name(compiled.names.symbols[routine.symbol].name)),
                         place_of(expansions[i].call)});
  }
  return map;
}

std::string print_line_map(const LineMap& map, const compiler::Image& image) {
  Json json;
  json["schema"] = "orb.map/1";
  json["file"] = map.files.front();
  json["lines"] = Json::array();
  for (const auto& line : image.lines) {
    Json entry;
    const auto place = map.places.find(line.number);
    if (map.known == Known::FileAndColumn && place != map.places.end()) {
      entry["file"] = map.files[place->second.file];
      entry["line"] = place->second.line;
      entry["column"] = place->second.column;
      if (!place->second.sub.empty())
        entry["sub"] = place->second.sub;
      for (const auto& call : place->second.calls)
        entry["calls"].push_back(in_words(map, call));
    } else {
      entry["line"] = line.source_line;
    }
    if (line.number != compiler::none)
      entry["basicLine"] = line.number;
    entry["offset"] = line.offset;
    entry["size"] = line.size;
    json["lines"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::optional<LineMap> parse_line_map(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("lines") || !json["lines"].is_array())
    return std::nullopt;
  LineMap map;
  const auto main = text_of(json, "file");
  if (!main.empty())
    map.files.push_back(main);
  for (const auto& line : json["lines"]) {
    const auto source_line = line.is_object() ? number_of(line, "line") : std::nullopt;
    if (!source_line)
      return std::nullopt;
    const auto own = text_of(line, "file");
    map.known = own.empty() ? map.known : Known::FileAndColumn;
    if (const auto robot_line = number_of(line, "basicLine"); robot_line && !map.files.empty())
      map.places.emplace(*robot_line, LinePlace{file_of(map, own.empty() ? main : own),
                                                *source_line,
                                                number_of(line, "column").value_or(1),
                                                text_of(line, "sub"),
                                                {}});
  }
  return map;
}

} // namespace orb::run
