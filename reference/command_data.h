#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// The command line as data: what the manual and completion are printed from.

namespace orb::reference {

/// What the value of an option or argument names, so that completion can offer it.
enum class ValueKind : std::uint8_t {
  Nothing, ///< a flag
  Text,    ///< free text or a number: nothing to offer
  Words,   ///< one of `Option::words`
  File,
  Port,    ///< a port URL or `@ball`
  Rule,    ///< a rule of the linters
  Known,   ///< anything that `orb explain` knows
  Section, ///< a section of `orb spec`
  Packet,  ///< a command of the API by name
  Firmware,
};

/// An option, or an argument where `argument` is not empty.
struct Option {
  std::vector<std::string> short_names; ///< without dashes
  std::vector<std::string> long_names;  ///< without dashes
  std::string argument;                 ///< its name in usage lines: `FILE`
  std::string summary;
  ValueKind kind = ValueKind::Nothing;
  std::vector<std::string> words; ///< the values it is checked against
  std::string placeholder;        ///< the value's name in usage lines; empty for a flag
  std::string default_value;
  std::string environment; ///< the variable that gives it too
  std::size_t most = 1;    ///< how many values it takes
  bool required = false;
  bool optional_value = false; ///< takes its value only as `--option=value`
  bool asks_for_help = false;  ///< `--help` or `--version`
};

struct Command {
  std::string name;
  std::string summary;
  std::string details;  ///< paragraphs after the summary; may be empty
  std::string examples; ///< a line each
  std::vector<Option> options;
};

/// orb itself, whose options stand before or after any command, and its commands. What is for
/// programs only is left out.
struct CommandLine {
  Command orb;
  std::vector<Command> commands;
};

} // namespace orb::reference
