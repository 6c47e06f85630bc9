#pragma once

#include "base/source.h"
#include "repair/tokens.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Decides which replacement lines are safe to apply without asking. A replacement is safe if only
// its notation differs: every number, name, text and operator in it was typed, in that order, and
// nothing typed is lost. Each difference is a row of a table of small rewrites (safety.cpp); an
// inserted or removed sign must have only one possible position. Anything else may be proposed, but
// the user decides.

namespace orb::repair {

/// Facts of the program for reading a line.
struct Reading {
  Language language = Language::Basic;
  std::span<const std::string_view> words; ///< of the language
  std::span<const std::string> names;      ///< defined by the program
  std::function<bool(std::string_view line)> parses;
  /// The line number of a label, in orbBasic.
  std::function<std::string(std::string_view label)> number_of = {};
};

/// The names that a program defines: variables, subs, constants, labels, macros.
std::vector<std::string> defined_names(const Source& source, Language language);

/// True if the replacement says the same in another notation. Both are whole lines, with number and
/// comment; several are separated by line endings.
bool says_the_same(std::string_view said, std::string_view written, const Reading& reading);

/// A rewrite that changes only the notation, as a row of its table.
struct Notation {
  std::string_view name;
  Language language; ///< of its example
  std::string_view said;
  std::string_view written;
};

/// The table, for its test.
std::vector<Notation> notations();

} // namespace orb::repair
