#include "base/catalogue.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace orb {
namespace {

/// Names and figures, which every language has alike: `heading`, `90 ms`, `red, green, blue`.
bool is_names_and_figures(std::string_view text) {
  while (true) {
    const auto blank = text.find(' ');
    if (blank == std::string_view::npos)
      return !text.empty();
    const auto word = text.substr(0, blank);
    const bool is_figure = word.find_first_not_of("-0123456789.") == std::string_view::npos;
    if (word.empty() || (!is_figure && word.back() != ','))
      return false;
    text.remove_prefix(blank + 1);
  }
}

/// What ends the quotes that `before` opens; empty where it opens none.
std::string_view end_of_quotes(std::string_view before) {
  return before.ends_with("`")    ? "`"
         : before.ends_with("\"") ? "\""
         : before.ends_with("“")  ? "”"
                                  : "";
}

} // namespace

std::optional<Catalogue> Catalogue::read(std::string_view json) {
  return of(nlohmann::json::parse(json, nullptr, false));
}

std::optional<Catalogue> Catalogue::marked(std::string_view json) {
  auto document = nlohmann::json::parse(json, nullptr, false);
  if (document.is_object())
    for (const auto& [english, translation] : document.items())
      translation = "⟦" + english + "⟧";
  return of(document);
}

std::optional<Catalogue> Catalogue::of(const nlohmann::json& texts) {
  if (!texts.is_object())
    return std::nullopt;
  Catalogue catalogue;
  for (const auto& [english, translation] : texts.items()) {
    if (!translation.is_string())
      return std::nullopt;
    catalogue.add(english, translation.get<std::string>());
  }
  std::stable_sort(catalogue.templates_.begin(), catalogue.templates_.end(),
                   [](const auto& a, const auto& b) { return a.fixed > b.fixed; });
  return catalogue;
}

void Catalogue::add(const std::string& english, std::string translation) {
  auto open = english.find('{');
  if (open == std::string::npos) {
    whole_.emplace(english, std::move(translation));
    return;
  }
  Template row;
  row.before = english.substr(0, open);
  row.translation = std::move(translation);
  row.fixed = row.before.size();
  while (open != std::string::npos) {
    const auto close = std::min(english.find('}', open), english.size());
    const auto next = english.find('{', close);
    Hole hole;
    hole.name = english.substr(open + 1, close - open - 1);
    hole.end = end_of_quotes(std::string_view(english).substr(0, open));
    hole.after = english.substr(std::min(close + 1, english.size()), next - close - 1);
    row.fixed += hole.after.size();
    row.holes.push_back(std::move(hole));
    open = next;
  }
  templates_.push_back(std::move(row));
}

/// Whether the holes from that one on take up `rest`. What fills a hole is looked at when the holes
/// after it fit.
bool Catalogue::fill(const Template& row, std::size_t at, std::string_view rest,
                     Fillers& fillers) const {
  if (at == row.holes.size())
    return rest.empty();
  const auto& hole = row.holes[at];
  const bool is_last = at + 1 == row.holes.size();
  auto end =
      is_last ? rest.size() - std::min(rest.size(), hole.after.size()) : rest.find(hole.after, 1);
  for (; end != std::string_view::npos && end > 0; end = rest.find(hole.after, end + 1)) {
    if (rest.substr(end, hole.after.size()) != hole.after)
      return false;
    const auto text = rest.substr(0, end);
    if (!hole.end.empty() && text.find(hole.end) != std::string_view::npos)
      return false;
    if (fill(row, at + 1, rest.substr(end + hole.after.size()), fillers))
      if (auto said = filler(hole, text)) {
        fillers[hole.name] = *std::move(said);
        return true;
      }
    if (is_last)
      return false;
  }
  return false;
}

std::optional<std::string> Catalogue::filler(const Hole& hole, std::string_view text) const {
  if (hole.end == "`" || hole.end == "\"")
    return std::string(text);
  if (auto said = find(text))
    return said;
  if (!hole.end.empty() || is_names_and_figures(text))
    return std::string(text);
  return std::nullopt;
}

std::optional<std::string> Catalogue::find(std::string_view english) const {
  if (const auto known = whole_.find(std::string(english)); known != whole_.end())
    return known->second;
  for (const auto& row : templates_) {
    Fillers fillers;
    if (english.starts_with(row.before) && fill(row, 0, english.substr(row.before.size()), fillers))
      return with_holes_filled(row.translation, fillers);
  }
  return std::nullopt;
}

std::string Catalogue::say(std::string_view english) const {
  return find(english).value_or(std::string(english));
}

std::string with_holes_filled(std::string_view text,
                              const std::unordered_map<std::string, std::string>& fillers) {
  std::string out;
  while (true) {
    const auto open = text.find('{');
    const auto close = open == std::string_view::npos ? open : text.find('}', open);
    if (close == std::string_view::npos)
      return out.append(text);
    const auto filler = fillers.find(std::string(text.substr(open + 1, close - open - 1)));
    out += text.substr(0, open);
    out += filler == fillers.end() ? text.substr(open, close + 1 - open) : filler->second;
    text.remove_prefix(close + 1);
  }
}

} // namespace orb
