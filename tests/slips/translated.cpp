#include "slips/translated.h"

#include "base/render.h"
#include "base/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace slips {
namespace {

using nlohmann::json;

json findings_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return json::parse(std::string(std::istreambuf_iterator<char>(in), {})).at("findings");
}

/// True if each text of the message has a translation.
bool knows(const json& texts, const orb::Message& message) {
  return (message.text() == nullptr || texts.contains(message.text()->english)) &&
         std::all_of(message.fillers().begin(), message.fillers().end(),
                     [&](const auto& filler) { return knows(texts, filler); });
}

} // namespace

void Heard::hear(const orb::Message& message) {
  const auto sentence = orb::in_english(message);
  ++times[sentence];
  messages[sentence] = message;
}

void hear_frame(Heard& heard) {
  const auto listen = [&heard](const orb::Message& message) {
    heard.hear(message);
    return orb::in_english(message);
  };
  static constexpr orb::Rule rules[] = {{"i", orb::Severity::Info, "", "", "", ""},
                                        {"w", orb::Severity::Warning, "", "", "", ""},
                                        {"e", orb::Severity::Error, "", "", "", ""}};
  const orb::Source source("a.bas", "10 end\n");
  for (const std::size_t n : {0U, 1U, 2U}) {
    std::vector<orb::FileFindings> files(std::max<std::size_t>(n, 1));
    for (const auto& rule : rules)
      for (std::size_t i = 0; i < n; ++i) {
        auto& finding = files[0].diagnostics.emplace_back(
            orb::finding(rule, {0, 2}, orb::texts::Unexpected("a"), orb::texts::RemoveIt()));
        finding.notes.push_back({{0, 2}, orb::texts::Unexpected("a")});
        orb::render_text(source, finding, {}, listen);
      }
    orb::render_summary(files, listen);
  }
}

Coverage translate_all(const Heard& heard, const std::filesystem::path& translations) {
  std::vector<json> languages;
  for (const auto& entry : std::filesystem::directory_iterator(translations))
    languages.push_back(findings_of(entry.path()));
  Coverage coverage;
  for (const auto& [sentence, times] : heard.times) {
    coverage.said += times;
    const auto& message = heard.messages.at(sentence);
    if (std::all_of(languages.begin(), languages.end(),
                    [&](const json& texts) { return knows(texts, message); }))
      coverage.translated += times;
    else
      coverage.missing += fmt::format("{:4} {}\n", times, sentence);
  }
  return coverage;
}

} // namespace slips
