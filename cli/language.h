#pragma once

#include "cli/context.h"

#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace orb::cli {

/// What a source file is written in.
enum class Language { Basic, Macro };

/// Adds `--lang basic|macro`, which overrides the ending of file names.
void add_language_option(CLI::App& command, std::string& lang);

/// The language of `path`: what `lang` says, else its ending (`.bas`, `.orbbas`, `.macro`).
std::optional<Language> language_of(std::string_view path, std::string_view lang);

/// As above, for files that must be sources: reports to stderr and sets the exit code where it
/// cannot be told.
std::optional<Language> require_language(Context& context, const std::string& path,
                                         const std::string& lang);

} // namespace orb::cli
