#include "slips/translated.h"

#include "base/catalogue.h"
#include "base/render.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

namespace slips {
namespace {

using nlohmann::json;

/// A catalogue that says which of its keys it was asked for: each is translated as its number.
struct Asked {
  std::vector<std::string> keys;
  orb::Catalogue catalogue;
};

json findings_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return json::parse(std::string(std::istreambuf_iterator<char>(in), {})).at("findings");
}

constexpr char mark = '\x01'; // stands in no sentence

/// Key 3 as `\x01` and 3, and what fills its holes.
Asked numbered(const json& findings) {
  Asked asked;
  json marks = json::object();
  for (const auto& [english, translation] : findings.items()) {
    auto said = fmt::format("{}{}", mark, asked.keys.size());
    for (auto open = english.find('{'); open != std::string::npos;
         open = english.find('{', open + 1))
      said += " " + english.substr(open, english.find('}', open) + 1 - open);
    marks[english] = said;
    asked.keys.push_back(english);
  }
  asked.catalogue = *orb::Catalogue::read(marks.dump());
  return asked;
}

void note_keys(std::string_view said, std::set<std::size_t>& used) {
  for (auto at = said.find(mark); at != std::string_view::npos; at = said.find(mark, at + 1))
    used.insert(std::stoul(std::string(said.substr(at + 1))));
}

} // namespace

void hear_frame(Heard& heard) {
  const auto listen = [&heard](std::string_view text) {
    ++heard[std::string(text)];
    return std::string(text);
  };
  static constexpr orb::Rule rules[] = {{"i", orb::Severity::Info, "", "", "", ""},
                                        {"w", orb::Severity::Warning, "", "", "", ""},
                                        {"e", orb::Severity::Error, "", "", "", ""}};
  const orb::Source source("a.bas", "10 end\n");
  for (const std::size_t n : {0U, 1U, 2U}) {
    std::vector<orb::FileFindings> files(std::max<std::size_t>(n, 1));
    for (const auto& rule : rules)
      for (std::size_t i = 0; i < n; ++i) {
        files[0].diagnostics.push_back(orb::finding(rule, {0, 2}, "`a` is not a number"));
        files[0].diagnostics.back().help = "remove it";
        files[0].diagnostics.back().notes.push_back({{0, 2}, "missing value"});
        orb::render_text(source, files[0].diagnostics.back(), {}, listen);
      }
    orb::render_summary(files, listen);
  }
}

void hear_transcripts(const std::filesystem::path& folder, Heard& heard) {
  constexpr std::string_view help = "  help: ";
  constexpr std::string_view note = ": note: ";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    for (std::string line; entry.is_regular_file() && std::getline(in, line);)
      if (const auto rule = line.find("]: "); line.starts_with(help))
        ++heard[line.substr(help.size())];
      else if (rule != std::string::npos)
        ++heard[line.substr(rule + 3)];
      else if (const auto place = line.find(note); place != std::string::npos)
        ++heard[line.substr(place + note.size())];
  }
}

Coverage translate_all(const Heard& heard, const Heard& elsewhere,
                       const std::filesystem::path& translations) {
  Coverage coverage;
  Heard missing;
  for (const auto& entry : std::filesystem::directory_iterator(translations)) {
    const auto asked = numbered(findings_of(entry.path()));
    std::set<std::size_t> used;
    for (const auto& [sentence, times] : heard)
      if (const auto said = asked.catalogue.find(sentence))
        note_keys(*said, used);
      else
        missing[sentence] = times;
    for (const auto& [sentence, times] : elsewhere)
      note_keys(asked.catalogue.say(sentence), used);
    for (std::size_t i = 0; i < asked.keys.size(); ++i)
      if (used.count(i) == 0)
        coverage.troubles +=
            fmt::format("{}: nobody says: {}\n", entry.path().filename().string(), asked.keys[i]);
  }
  for (const auto& [sentence, times] : heard) {
    coverage.said += times;
    if (missing.count(sentence) == 0)
      coverage.translated += times;
    else
      coverage.missing += fmt::format("{:4} {}\n", times, sentence);
  }
  return coverage;
}

} // namespace slips
