#pragma once

#include "cli/model/command.h"
#include "reference/command_data.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace orb::cli {

/// What became of the words of a command line.
struct Parsed {
  enum class Kind {
    Ran,    ///< the command that they name
    Told,   ///< `text` answers `--help` or `--version`
    Misread ///< `text` says why they make no sense; nothing has run
  } kind = Kind::Ran;
  std::string text;
  std::string command; ///< the one that was named; may be empty
};

/// The command line of orb: its commands with their options, and what reads it.
class CommandLine {
public:
  CommandLine(const std::string& name, const std::string& about, const std::string& examples);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The program itself, whose options stand before or after any command.
  Command root() const { return Command(*app_); }

  /// Adds `--version`, which prints what `version` returns, and `--help`.
  void add_help_and_version(std::function<std::string()> version, const std::string& summary);

  /// Reads words and runs the command that they name.
  Parsed parse(std::vector<std::string> words);

  /// Help as it is printed without words.
  std::string help() const;

private:
  std::unique_ptr<CLI::App> app_;
};

/// The command line as data, for the manual and completion.
reference::CommandLine as_data(const Command& root);

} // namespace orb::cli
