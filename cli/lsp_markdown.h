#pragma once

#include "cli/knowledge.h"

#include <optional>
#include <string>
#include <string_view>

namespace orb::cli {

/// An entry of the tables as an editor shows it in a hover. `language` colours the example.
std::string entry_markdown(const Section& section, const Entry& entry, std::string_view language);

/// The entry of `section` that answers to `word`, ready to be shown; nothing where none does.
std::optional<std::string> find_markdown(const Section& section, std::string_view word,
                                         std::string_view language);

} // namespace orb::cli
