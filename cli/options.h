#pragma once

#include "reference/command_line.h"

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
} // namespace CLI

namespace orb::cli {

/// "; did you mean `…`?" for a word that is none of `names`, or nothing.
std::string meant_instead(const std::string& word, const std::vector<std::string>& names);

/// The names of the rows of a table.
template <class Rows>
std::vector<std::string> names_of(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows)
    names.emplace_back(row.name);
  return names;
}

/// A check that a value is one of `words`. A misspelt value is answered with the word that was
/// probably meant; help, completion and man pages list the words.
CLI::Validator one_of(std::vector<std::string> words);

/// A check that a value is a whole number of that range, decimal or 0x hex; help lists the range.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t greatest);

/// A check that a value is a number of that range; not a number is in none.
CLI::Validator number_between(double least, double greatest);

/// Whether the command is for programs, not for people: left out of help, completion and manual.
bool is_hidden(const CLI::App& command);

/// The command line as data, for the manual and completion.
reference::CommandLine command_line(const CLI::App& app);

} // namespace orb::cli
