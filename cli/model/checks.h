#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace orb::cli {

/// What the value of an option has to be.
struct Check {
  std::function<std::string(const std::string&)> problem; ///< why it is not; empty where it is
  std::string range;                                      ///< as help shows it; may be empty
};

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
Check one_of(std::vector<std::string> words);

/// A check that a value is a whole number of that range, decimal or 0x hex; help lists the range.
Check whole_number(std::uint64_t least, std::uint64_t greatest);

/// A check that a value is a number of that range; not a number is in none.
Check number_between(double least, double greatest);

} // namespace orb::cli
