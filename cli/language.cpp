#include "cli/language.h"

#include "cli/options.h"
#include "disk/disk.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace orb::cli {

void add_language_option(CLI::App& command, std::string& lang) {
  command.add_option("--lang", lang, "the language, where the file's ending does not tell")
      ->check(one_of({"basic", "macro"}));
}

std::optional<Language> language_of(std::string_view path, std::string_view lang) {
  if (lang == "basic")
    return Language::Basic;
  if (lang == "macro")
    return Language::Macro;
  if (path.ends_with(".bas") || path.ends_with(".orbbas"))
    return Language::Basic;
  if (path.ends_with(".macro"))
    return Language::Macro;
  return std::nullopt;
}

std::optional<Language> require_language(Context& context, const std::string& path,
                                         const std::string& lang) {
  const auto language = language_of(path, lang);
  if (!language) {
    print_error(context, fmt::format("cannot tell the language of {} by its name; give "
                                     "`--lang basic` or `--lang macro`",
                                     disk::display_name(path)));
    context.exit = ExitCode::Usage;
  }
  return language;
}

} // namespace orb::cli
