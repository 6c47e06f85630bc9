#pragma once

// Shared by test files and stimulus scripts: their lines begin with a word from a table.

#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "reference/sections.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

inline constexpr std::string_view test_language_id = "orbtest";
inline constexpr std::string_view stimulus_language_id = "orbstimulus";

/// A word of a line with the words before it.
struct Spot {
  Span span;
  std::string_view word;
  std::vector<std::string_view> before;
};

/// The word at `offset`, also if that is in the middle of it.
Spot spot_at(const Source& source, std::uint32_t offset);

/// True where a stimulus word is expected: at the start of a line, or after `at` and a time.
bool is_stimulus_place(const Spot& spot);

/// Suggests the words of a table with their summaries.
template <class Rows>
void suggest_rows(Suggestions& out, const Rows& rows, const reference::Section& section,
                  std::string_view language) {
  for (const auto& row : rows)
    for (const auto& entry : section.entries)
      if (entry.name == row.word)
        out.items.push_back({std::string(row.word), SuggestionKind::Keyword, usage(row.slots),
                             entry_markdown(section, entry, language)});
}

/// The row of a word, or null.
template <class Rows>
auto row_of(const Rows& rows, std::string_view word) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.word == word; });
  return found == rows.end() ? nullptr : &*found;
}

/// A row as `word operands`, without separate parameters.
template <class Row>
Signature row_signature(const Row& row, const reference::Section& section,
                        std::string_view language) {
  SignatureText text(row.word);
  text.close(row.slots.empty() ? "" : " ");
  text.close(usage(row.slots));
  return text.take(0, find_markdown(section, row.word, language).value_or(""));
}

/// The words, numbers and texts of a line, and the line itself.
std::vector<Span> tokens_around(const Source& source, std::uint32_t offset);

} // namespace orb::editor
