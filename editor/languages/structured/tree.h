#pragma once

#include <string>
#include <string_view>

namespace orb::editor {

/// A structured program as JSON for who shows it in another form than text, such as blocks: one row
/// for each statement, line of comment and piece of text that is no statement, in order.
/// playground/README.md has the form.
std::string structured_tree(std::string_view text);

/// The words of structured programs as JSON, from the tables: what they mean, the values that they
/// take, the ranges of those.
std::string structured_vocabulary();

} // namespace orb::editor
