#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace orb::cli {

/// A constraint on the value of an option.
struct Check {
  /// returns what is wrong with a value; empty if nothing
  std::function<std::string(const std::string&)> problem;
  std::string range; ///< shown in help; may be empty
};

/// "; did you mean `…`?" for a misspelt word, else an empty text.
std::string meant_instead(const std::string& word, const std::vector<std::string>& names);

/// The names of the rows of a table.
template <class Rows>
std::vector<std::string> names_of(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows)
    names.emplace_back(row.name);
  return names;
}

/// Checks that a value is one of `words`. For a misspelt value it suggests the nearest word; help,
/// completion and man pages list the words.
Check one_of(std::vector<std::string> words);

/// Checks for a whole number in the range, decimal or 0x hex; help shows the range.
Check whole_number(std::uint64_t least, std::uint64_t greatest);

/// Checks for a number in the range; NaN is outside every range.
Check number_between(double least, double greatest);

} // namespace orb::cli
