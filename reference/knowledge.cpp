#include "reference/knowledge.h"

#include "reference/sections.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace orb::reference {
namespace {

std::string indented(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    out += fmt::format("  {}\n", text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

} // namespace

std::vector<Section> knowledge() {
  return {structured_words_section(), statements_section(),     words_section(),
          functions_section(),        letters_section(),        variables_section(),
          operators_section(),        colours_section(),        basic_errors_section(),
          limits_section(),           basic_flags_section(),    rules_section(),
          structured_rules_section(), macro_commands_section(), macro_flags_section(),
          macro_limits_section(),     macro_rules_section(),    stimulus_section(),
          stimulus_rules_section(),   course_rules_section(),   test_lines_section(),
          expectations_section(),     test_rules_section(),     api_commands_section(),
          api_messages_section(),     responses_section(),      streams_section(),
          firmwares_section(),        ball_section(),           robots_section(),
          robot_commands_section(),   client_rules_section(),   edu_calls_section(),
          edu_events_section()};
}

std::string print_entry(const Section& section, const Entry& entry, Style style) {
  auto out = fmt::format("{} ({})\n  {}\n", entry.name, section.kind, entry.summary);
  std::size_t width = 0;
  for (const auto& fact : entry.facts)
    width = std::max(width, fact.first.size());
  for (const auto& [caption, value] : entry.facts)
    out += fmt::format("  {:<{}}  {}\n", caption, width, value);
  if (style.color)
    for (const auto& swatch : entry.swatches)
      out += fmt::format("  \x1b[48;2;{};{};{}m      \x1b[0m {}\n", swatch.red, swatch.green,
                         swatch.blue, swatch.name);
  if (!entry.explanation.empty())
    out += "\n" + indented(entry.explanation);
  for (const auto& [caption, source] : entry.code)
    out += fmt::format("\n{}:\n{}", caption, indented(source));
  return out;
}

std::string print_entries(const std::vector<Section>& sections, Style style,
                          const std::function<bool(const std::string&)>& is_meant) {
  std::string out;
  for (const auto& section : sections)
    for (const auto& entry : section.entries)
      if (is_meant(entry.name) || std::any_of(entry.aliases.begin(), entry.aliases.end(), is_meant))
        out += (out.empty() ? "" : "\n") + print_entry(section, entry, style);
  return out;
}

std::string print_json(const std::vector<Section>& sections) {
  nlohmann::ordered_json json;
  json["schema"] = "orb.spec/1";
  for (const auto& section : sections) {
    auto& entries = json[std::string(section.id)];
    entries = nlohmann::ordered_json::array();
    for (const auto& entry : section.entries) {
      nlohmann::ordered_json item;
      item["name"] = entry.name;
      if (!entry.aliases.empty())
        item["aliases"] = entry.aliases;
      item["summary"] = entry.summary;
      for (const auto& [caption, value] : entry.facts)
        item["facts"][caption] = value;
      if (!entry.explanation.empty())
        item["explanation"] = entry.explanation;
      for (const auto& [caption, source] : entry.code)
        item["code"][caption] = source;
      entries.push_back(std::move(item));
    }
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

} // namespace orb::reference
