#pragma once

#include <string>
#include <string_view>

namespace orb::editor {

/// A structured program as JSON for views other than text, such as blocks. One row for each
/// statement, comment line and piece of text outside statements, in order. playground/README.md
/// describes the format.
std::string structured_tree(std::string_view text);

/// The words of structured programs as JSON, from the tables: meanings, values and their ranges.
std::string structured_vocabulary();

} // namespace orb::editor
