#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace orb::editor {

/// A directive of macro source, described for editors. The assembler's list is authoritative; a
/// test compares the two.
struct MacroDirective {
  std::string_view word; ///< without the dot
  std::string_view usage;
  std::string_view summary;
};

inline constexpr auto macro_directives = std::to_array<MacroDirective>({
    {"macro", ".macro NAME [id=N] [flags=FLAG,…]",
     "begins a macro; goto, gosub and branches find it by its name"},
    {"const", ".const NAME = VALUE", "gives a number a name"},
    {"raw", ".raw BYTE…", "inserts bytes as they are"},
    {"noend", ".noend", "leaves out the End that the assembler adds"},
});

inline std::vector<std::string_view> macro_directive_words() {
  std::vector<std::string_view> words;
  for (const auto& row : macro_directives)
    words.push_back(row.word);
  return words;
}

} // namespace orb::editor
