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

/// `text` fit for a cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : c == '\n' ? std::string("<br>") : std::string(1, c);
  return out;
}

/// The captions that the entries of a section use, in the order of their first appearance.
std::vector<std::string> captions(const Section& section) {
  std::vector<std::string> names;
  for (const auto& entry : section.entries)
    for (const auto& fact : entry.facts)
      if (std::find(names.begin(), names.end(), fact.first) == names.end())
        names.push_back(fact.first);
  return names;
}

/// Sections whose entries all say the same kinds of things fit a table; others become chapters.
bool fits_table(const Section& section) {
  const auto plain = [](const Entry& entry) {
    return entry.explanation.empty() && entry.code.empty();
  };
  return captions(section).size() <= 5 &&
         std::all_of(section.entries.begin(), section.entries.end(), plain);
}

std::string table(const Section& section) {
  const auto names = captions(section);
  auto out = fmt::format("| {} |", section.kind);
  for (const auto& name : names)
    out += fmt::format(" {} |", name);
  out += " what it is |\n|---|";
  for (std::size_t i = 0; i < names.size(); ++i)
    out += "---|";
  out += "---|\n";
  for (const auto& entry : section.entries) {
    out += fmt::format("| `{}` |", cell(entry.name));
    for (const auto& name : names) {
      const auto fact = std::find_if(entry.facts.begin(), entry.facts.end(),
                                     [&](const auto& f) { return f.first == name; });
      out += fmt::format(" {} |", fact == entry.facts.end() ? "" : cell(fact->second));
    }
    out += fmt::format(" {} |\n", cell(entry.summary));
  }
  return out;
}

std::string chapter(const Entry& entry) {
  auto out = fmt::format("## `{}`\n\n{}\n\n", entry.name, entry.summary);
  for (const auto& [caption, value] : entry.facts)
    out += fmt::format("- {}: {}\n", caption, value);
  if (!entry.facts.empty())
    out += "\n";
  if (!entry.explanation.empty())
    out += fmt::format("{}\n\n", entry.explanation);
  for (const auto& [caption, source] : entry.code)
    out += fmt::format("{}:\n\n```\n{}\n```\n\n", caption,
                       source.ends_with("\n") ? source.substr(0, source.size() - 1) : source);
  return out;
}

} // namespace

std::vector<Section> knowledge() {
  return {statements_section(),   functions_section(),    variables_section(),
          operators_section(),    basic_errors_section(), limits_section(),
          basic_flags_section(),  rules_section(),        macro_commands_section(),
          macro_flags_section(),  macro_rules_section(),  stimulus_rules_section(),
          api_commands_section(), api_messages_section(), responses_section(),
          streams_section(),      firmwares_section()};
}

std::string print_entry(const Section& section, const Entry& entry) {
  auto out = fmt::format("{} ({})\n  {}\n", entry.name, section.kind, entry.summary);
  std::size_t width = 0;
  for (const auto& fact : entry.facts)
    width = std::max(width, fact.first.size());
  for (const auto& [caption, value] : entry.facts)
    out += fmt::format("  {:<{}}  {}\n", caption, width, value);
  if (!entry.explanation.empty())
    out += "\n" + indented(entry.explanation);
  for (const auto& [caption, source] : entry.code)
    out += fmt::format("\n{}:\n{}", caption, indented(source));
  return out;
}

std::string print_markdown(const Section& section) {
  auto out = fmt::format("<!-- Printed by `orb spec --markdown {}`; a test compares them. -->\n"
                         "# {}\n\n",
                         section.id, section.title);
  if (fits_table(section))
    return out + table(section);
  if (!section.overview.empty())
    out += section.overview + "\n";
  for (const auto& entry : section.entries)
    out += chapter(entry);
  out.pop_back(); // one line end at the end of the file
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
