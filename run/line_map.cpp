#include "run/line_map.h"

#include <nlohmann/json.hpp>

namespace orb::run {

LineMap line_map(const std::string& file, const compiler::Image& image) {
  LineMap map{file, {}};
  for (const auto& line : image.lines)
    if (line.number != compiler::none)
      map.source_line.emplace(line.number, line.source_line);
  return map;
}

std::string print_line_map(const std::string& file, const compiler::Image& image) {
  nlohmann::ordered_json json;
  json["schema"] = "orb.map/1";
  json["file"] = file;
  json["lines"] = nlohmann::ordered_json::array();
  for (const auto& line : image.lines) {
    nlohmann::ordered_json entry;
    entry["line"] = line.source_line;
    if (line.number != compiler::none)
      entry["basicLine"] = line.number;
    entry["offset"] = line.offset;
    entry["size"] = line.size;
    json["lines"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::optional<LineMap> parse_line_map(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("lines") || !json["lines"].is_array())
    return std::nullopt;
  LineMap map;
  if (json.contains("file") && json["file"].is_string())
    map.file = json["file"].get<std::string>();
  for (const auto& line : json["lines"]) {
    if (!line.is_object() || !line.contains("line") || !line["line"].is_number_unsigned())
      return std::nullopt;
    if (line.contains("basicLine") && line["basicLine"].is_number_unsigned())
      map.source_line.emplace(line["basicLine"].get<std::uint32_t>(),
                              line["line"].get<std::uint32_t>());
  }
  return map;
}

} // namespace orb::run
