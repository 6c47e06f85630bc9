#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
} // namespace CLI

namespace orb::cli {

/// A check that a value is one of `words`. A misspelt value is answered with the word that was
/// probably meant; help, completion and man pages list the words.
CLI::Validator one_of(std::vector<std::string> words);

/// What the value of an option or argument names, so that completion can offer it.
enum class ValueKind : std::uint8_t {
  Nothing, ///< a flag
  Text,    ///< free text or a number: nothing to offer
  Words,   ///< one of `words_of(option)`
  File,
  Port,    ///< a port URL or `@ball`
  Rule,    ///< a rule of the linters
  Known,   ///< anything that `orb explain` knows
  Section, ///< a section of `orb spec`
  Packet,  ///< a command of the API by name
  Firmware,
};

ValueKind value_kind(const CLI::Option& option);

/// The words that `option` is checked against, where it is checked by `one_of`.
std::vector<std::string> words_of(const CLI::Option& option);

/// The name of the value in usage lines: `FILE`, `URL`; empty for flags.
std::string placeholder(const CLI::Option& option);

/// Whether the command is for programs, not for people: left out of help, completion and manual.
bool is_hidden(const CLI::App& command);

} // namespace orb::cli
