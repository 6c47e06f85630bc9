#pragma once

#include "base/style.h"
#include "reference/command_data.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orb::reference {

/// A colour to show next to its name.
struct Swatch {
  std::string name; ///< `1 red`
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// An entry of the tables, ready for output in any format.
struct Entry {
  std::string name;                      ///< what users type: `goroll`, `08h`, `unknown-statement`
  std::vector<std::string> aliases = {}; ///< other words that lead to it: `8`, `Divide by zero`
  std::string summary = {};              ///< one sentence
  std::vector<std::pair<std::string, std::string>> facts = {}; ///< usage, ranges, since, source…
  std::string explanation = {};                                ///< paragraphs; may be empty
  /// sources with captions: `bad`, `good`
  std::vector<std::pair<std::string, std::string>> code = {};
  std::vector<Swatch> swatches = {}; ///< shown where colours are available
};

/// A table of the robot or of the tools, as a chapter of the reference.
struct Section {
  /// `statements`: also a file of docs/reference/ and a word of `orb spec`
  std::string_view id;
  std::string_view title; ///< `Statements`
  std::string_view kind;  ///< the noun for an entry: `statement`
  std::vector<Entry> entries;
  std::string overview = {}; ///< Markdown before the entries of the page; may be empty
};

/// All sections, in reading order.
std::vector<Section> knowledge();

/// The commands of orb and their options; an option shared by several commands appears once.
std::vector<Section> commands_knowledge(const CommandLine& line);

/// Prints an entry as `orb explain` does.
std::string print_entry(const Section& section, const Entry& entry, Style style);

/// Prints every entry whose name or alias satisfies `is_meant`: `roll`, for instance, is a variable
/// and a macro command. Empty if there is none.
std::string print_entries(const std::vector<Section>& sections, Style style,
                          const std::function<bool(const std::string&)>& is_meant);

/// A section as a page of docs/reference/, with links to the other pages (reference/markdown.cpp).
std::string print_markdown(const std::vector<Section>& sections, const Section& section);

/// The language on one printable page: docs/reference/cheatsheet.md (reference/cheatsheet.cpp).
std::string print_cheatsheet();

/// All sections as one JSON document.
std::string print_json(const std::vector<Section>& sections);

} // namespace orb::reference
