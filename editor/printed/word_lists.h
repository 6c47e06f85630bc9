#pragma once

#include <string_view>
#include <vector>

// The words of each language by colour, for all grammars and syntax files.

namespace orb::editor {

using Words = std::vector<std::string_view>;

/// The words in the rows of a table, filtered by `keep`.
template <typename Table, typename Keep>
Words words_of(const Table& table, Keep keep) {
  Words words;
  for (const auto& row : table)
    if (keep(row))
      words.emplace_back(row.word);
  return words;
}
template <typename Table>
Words words_of(const Table& table) {
  return words_of(table, [](const auto&) { return true; });
}

Words control_words();
Words statement_words();
Words function_words();
Words variable_words();

/// The words only structured programs have, and those that end blocks or jump.
Words structured_control_words();
Words structured_statement_words();

Words macro_command_words();
/// Flags and named values of operands.
Words macro_value_words();

Words test_words();
Words expectation_words();
Words stimulus_words();

} // namespace orb::editor
