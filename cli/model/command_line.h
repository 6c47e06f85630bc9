#pragma once

#include "cli/model/command.h"
#include "reference/command_data.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace orb::cli {

/// The result of parsing a command line.
struct Parsed {
  enum class Kind {
    Ran,    ///< the command ran
    Help,   ///< `text` answers `--help` or `--version`
    Misread ///< `text` says what is wrong; nothing ran
  } kind = Kind::Ran;
  std::string text;
  std::string command; ///< the chosen one; may be empty
};

/// The command line of orb: commands, options, and their parser.
class CommandLine {
public:
  CommandLine(const std::string& name, const std::string& about, const std::string& examples);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The program itself; its options may precede or follow any command.
  Command root() const { return Command(*app_); }

  /// Adds `--version`, which prints the result of `version`, and `--help`.
  void add_help_and_version(std::function<std::string()> version, const std::string& summary);

  /// Parses words and runs the command.
  Parsed parse(std::vector<std::string> words);

  /// The help for orb without arguments.
  std::string help() const;

private:
  std::unique_ptr<CLI::App> app_;
};

/// Returns the command line as data, for the manual and completion.
reference::CommandLine as_data(const Command& root);

} // namespace orb::cli
