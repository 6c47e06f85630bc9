#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// The command line as data, from which the manual and completion are generated.

namespace orb::reference {

/// The kind of value of an option or argument, for completion.
enum class ValueKind : std::uint8_t {
  Nothing, ///< a flag
  Text,    ///< free text or a number: no candidates
  Words,   ///< one of `Option::words`
  File,
  Port,    ///< a port URL or `@ball`
  Rule,    ///< a rule of the linters
  Known,   ///< anything `orb explain` knows
  Section, ///< a section of `orb spec`
  Packet,  ///< a command of the API by name
  Firmware,
};

/// An option, or an argument if `argument` is not empty.
struct Option {
  std::vector<std::string> short_names; ///< without dashes
  std::vector<std::string> long_names;  ///< without dashes
  std::string argument;                 ///< its name in usage lines: `FILE`
  std::string summary;
  ValueKind kind = ValueKind::Nothing;
  std::vector<std::string> words; ///< allowed values
  std::string placeholder;        ///< placeholder in usage lines; empty for a flag
  std::string default_value;
  std::string environment; ///< environment variable that also sets it
  std::size_t most = 1;    ///< maximum number of values
  bool required = false;
  bool optional_value = false; ///< takes a value only as `--option=value`
  bool asks_for_help = false;  ///< `--help` or `--version`
};

struct Command {
  std::string name;
  std::string summary;
  std::string details;  ///< paragraphs after the summary; may be empty
  std::string examples; ///< one per line
  std::vector<Option> options;
};

/// orb itself, whose options may precede or follow any command, with its commands. Leaves out what
/// only programs use.
struct CommandLine {
  Command orb;
  std::vector<Command> commands;
};

} // namespace orb::reference
