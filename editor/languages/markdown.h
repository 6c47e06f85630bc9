#pragma once

#include "reference/knowledge.h"

#include <optional>
#include <string>
#include <string_view>

namespace orb::editor {

/// An entry of the tables as an editor shows it in a hover. `language` colours the example.
std::string entry_markdown(const reference::Section& section, const reference::Entry& entry,
                           std::string_view language);

/// The entry of `section` that answers to `word`, ready to be shown; nothing where none does.
std::optional<std::string> find_markdown(const reference::Section& section, std::string_view word,
                                         std::string_view language);

} // namespace orb::editor
