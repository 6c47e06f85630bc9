#pragma once

#include "base/render.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::cli {

/// A language, and its findings, verdicts and lessons as base/catalogue.h reads them:
/// translations/CODE.json.
struct Translation {
  std::string_view code; ///< ISO 639-1
  std::string_view texts;
};

/// Those that the program carries, made by cli/CMakeLists.txt.
std::span<const Translation> translations();

/// What `--lang-ui` takes: English, and each that there is a translation for.
std::vector<std::string> ui_languages();

/// The language of tests and translators: findings in English, what is translated between `⟦` and
/// `⟧`. Private to its users in ISO 639-2.
inline constexpr std::string_view pseudo_language = "qps";

/// The code of that language, or for none of that of the environment, as say_in() has it; `en`
/// where there is no translation.
std::string spoken_language(std::string_view language);

/// How findings are said in that language; for none, in that of the environment: LC_ALL,
/// LC_MESSAGES or LANG, where the program has it. Lasts as long as the process.
Say say_in(std::string_view language);

} // namespace orb::cli
