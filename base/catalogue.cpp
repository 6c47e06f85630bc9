#include "base/catalogue.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace orb {
namespace {

using Texts = std::unordered_map<std::string, std::string>;

std::optional<Texts> texts_of(std::string_view json) {
  const auto document = nlohmann::json::parse(json, nullptr, false);
  if (!document.is_object())
    return std::nullopt;
  Texts texts;
  for (const auto& [english, translation] : document.items()) {
    if (!translation.is_string())
      return std::nullopt;
    texts.emplace(english, translation.get<std::string>());
  }
  return texts;
}

} // namespace

std::optional<Catalogue> Catalogue::read(std::string_view json) {
  auto texts = texts_of(json);
  if (!texts)
    return std::nullopt;
  Catalogue catalogue;
  catalogue.texts_ = *std::move(texts);
  return catalogue;
}

std::optional<Catalogue> Catalogue::marked(std::string_view json) {
  auto catalogue = read(json);
  if (catalogue)
    for (auto& [english, translation] : catalogue->texts_)
      translation = "⟦" + english + "⟧";
  return catalogue;
}

std::optional<std::string> Catalogue::find(const Message& message) const {
  const auto* text = message.text();
  const auto known = texts_.find(text == nullptr ? message.words() : std::string(text->english));
  if (known == texts_.end())
    return std::nullopt;
  if (text == nullptr)
    return known->second;
  std::vector<std::string> fillers;
  for (const auto& filler : message.fillers()) {
    const auto said = filler.text() == nullptr ? filler.words() : find(filler);
    if (!said)
      return std::nullopt;
    fillers.push_back(*said);
  }
  return with_holes_filled(known->second, [&](std::string_view name) {
    const auto place = place_of_hole(text->english, name);
    return place < fillers.size() ? fillers[place] : fmt::format("{{{}}}", name);
  });
}

std::string Catalogue::say(const Message& message) const {
  return find(message).value_or(in_english(message));
}

} // namespace orb
