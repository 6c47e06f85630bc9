#include "cli/context/language.h"

#include "base/catalogue.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

namespace orb::cli {
namespace {

/// `de` from `de_DE.UTF-8`. POSIX's `C` matches no translation.
std::string language_of_environment() {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})
    if (const char* value = std::getenv(name); value != nullptr && *value != '\0') {
      const std::string_view locale(value);
      return std::string(locale.substr(0, locale.find_first_of("_.@-")));
    }
  return {};
}

/// The catalogue of a language, if the program includes it.
std::optional<Catalogue> catalogue_of(std::string_view code) {
  const auto all = translations();
  if (code == pseudo_language && !all.empty())
    return Catalogue::marked(all.front().texts);
  const auto translation =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.code == code; });
  return translation == all.end() ? std::nullopt : Catalogue::read(translation->texts);
}

} // namespace

std::vector<std::string> ui_languages() {
  std::vector<std::string> codes = {"en"};
  for (const auto& one : translations())
    codes.emplace_back(one.code);
  return codes;
}

std::string spoken_language(std::string_view language) {
  auto code = language.empty() ? language_of_environment() : std::string(language);
  const auto all = translations();
  const bool known =
      code == pseudo_language ||
      std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.code == code; });
  return known ? code : "en";
}

Say say_in(std::string_view language) {
  const auto code = language.empty() ? language_of_environment() : std::string(language);
  static std::map<std::string, std::optional<Catalogue>> read;
  static std::mutex reading;
  const std::lock_guard lock(reading);
  auto known = read.find(code);
  if (known == read.end())
    known = read.emplace(code, catalogue_of(code)).first;
  if (!known->second)
    return &in_english;
  return [&catalogue = *known->second](const Message& message) { return catalogue.say(message); };
}

} // namespace orb::cli
