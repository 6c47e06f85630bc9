#pragma once

#include "base/source.h"
#include "repair/tokens.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Which lines may be written without asking. A line that takes the place of another is safe when
// only its notation differs: every number, name, text and operator of it was typed, in that order,
// and nothing that was typed is lost. Each difference is one of a table of small rewrites
// (safety.cpp), where a sign that was put in or left out can stand in one place only. All else may
// be offered, but is for people to take.

namespace orb::repair {

/// What a program knows when a line of it is read.
struct Reading {
  Language language = Language::Basic;
  std::span<const std::string_view> words; ///< of the language
  std::span<const std::string> names;      ///< that the program defines
  std::function<bool(std::string_view line)> parses;
  /// The number of the line that has a label, in orbBasic.
  std::function<std::string(std::string_view label)> number_of = {};
};

/// The words that a program gives a meaning: variables, subs, constants, labels, macros.
std::vector<std::string> defined_names(const Source& source, Language language);

/// Whether the line or lines that are written say what was said, in another notation. Both are
/// whole, with their number and comment; several have line ends between them.
bool says_the_same(std::string_view said, std::string_view written, const Reading& reading);

/// A rewrite that changes the notation alone, as one line of its table.
struct Notation {
  std::string_view name;
  Language language; ///< of its example
  std::string_view said;
  std::string_view written;
};

/// The table, for its test.
std::vector<Notation> notations();

} // namespace orb::repair
