#pragma once

#include "reference/knowledge.h"

#include <optional>
#include <string>
#include <string_view>

namespace orb::editor {

/// Renders an entry of the tables for a hover; `language` colours the example.
std::string entry_markdown(const reference::Section& section, const reference::Entry& entry,
                           std::string_view language);

/// Renders the entry of `section` for `word`; nothing if there is none.
std::optional<std::string> find_markdown(const reference::Section& section, std::string_view word,
                                         std::string_view language);

} // namespace orb::editor
