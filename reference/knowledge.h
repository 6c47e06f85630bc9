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

/// A colour to be shown beside its name.
struct Swatch {
  std::string name; ///< `1 red`
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// One thing that the tables know, ready to be printed in any form.
struct Entry {
  std::string name; ///< what a user types: `goroll`, `08h`, `unknown-statement`
  std::vector<std::string> aliases = {}; ///< other words that find it: `8`, `Divide by zero`
  std::string summary = {};              ///< one sentence
  std::vector<std::pair<std::string, std::string>> facts = {}; ///< usage, ranges, since, source…
  std::string explanation = {};                                ///< paragraphs; may be empty
  std::vector<std::pair<std::string, std::string>> code = {};  ///< captioned sources: `bad`, `good`
  std::vector<Swatch> swatches = {};                           ///< shown where there is colour
};

/// A table of the robot, or of the tools, as a chapter of the reference.
struct Section {
  std::string_view id;    ///< `statements`: a file of docs/reference/ and a word of `orb spec`
  std::string_view title; ///< `Statements`
  std::string_view kind;  ///< what one entry is: `statement`
  std::vector<Entry> entries;
  std::string overview = {}; ///< Markdown in front of the entries of the page; may be empty
};

/// Everything the tables know, in the order in which a reader wants it.
std::vector<Section> knowledge();

/// The commands of orb and their options, each option once for all commands that have it.
std::vector<Section> commands_knowledge(const CommandLine& line);

/// One entry as `orb explain` prints it.
std::string print_entry(const Section& section, const Entry& entry, Style style);

/// Every entry that `is_meant` of its name or of an alias, one after the other: `roll` is a
/// variable and a macro command. Empty where there is none.
std::string print_entries(const std::vector<Section>& sections, Style style,
                          const std::function<bool(const std::string&)>& is_meant);

/// One section as a page of docs/reference/, with links to the pages of the others
/// (reference/markdown.cpp).
std::string print_markdown(const std::vector<Section>& sections, const Section& section);

/// The language on one page that can be printed: docs/cheatsheet.md (reference/cheatsheet.cpp).
std::string print_cheatsheet();

/// All sections as one JSON document.
std::string print_json(const std::vector<Section>& sections);

} // namespace orb::reference
