#pragma once

#include "cli/model/checks.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

// The option model, independent of its parser: compiling CLI11's header takes seconds, so only this
// folder includes it.
namespace CLI {
class App;
class Option;
} // namespace CLI

namespace orb::cli {

/// An option or argument being described. A handle: copies refer to the same option.
class Option {
public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option check(const Check& check) const;
  /// The same for a check that help does not mention.
  Option check(std::function<std::string(const std::string&)> problem) const;
  /// Sets the name of the value in help: `FILE`.
  Option type_name(const std::string& name) const;
  Option required() const;
  /// Makes help show the current value of the variable.
  Option show_default() const;
  Option show_default(const std::string& value) const;
  /// Rejects both together.
  Option excludes(const Option& other) const;
  /// Rejects the option without the other one.
  Option needs(const Option& other) const;
  /// Also reads the value from an environment variable; the command line wins.
  Option environment(const std::string& name) const;
  /// Takes one value per use; the words after it are arguments.
  Option one_value_each() const;
  /// Allows the option without a value; a value needs `--option=value`.
  Option value_optional() const;
  /// Splits one word into several values.
  Option separated_by(char separator) const;

  /// Returns true if the command line has it.
  bool given() const;
  /// Sets default values, which the command line overrides. Returns why they are invalid, if they
  /// are.
  std::optional<std::string> set_default(const std::vector<std::string>& values) const;

private:
  friend class Command;
  CLI::Option* option_;
};

/// A command of orb, or orb itself, being described. A handle: copies refer to the same command.
class Command {
public:
  explicit Command(CLI::App& app) : app_(&app) {}

  /// Adds a command. `examples` are command lines to paste, one per line; help prints them first.
  Command add_command(const std::string& name, const std::string& summary,
                      const std::string& examples) const;

  /// Adds an option (`-o,--out`) or an argument (`FILE`). Parsing stores its value in `value`:
  /// strings, numbers and vectors of them (command.cpp).
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& summary) const;
  /// The same with a function that receives the value.
  Option add_option(const std::string& names, std::function<void(const std::string&)> take,
                    const std::string& summary) const;

  /// Adds an option without a value. With an optional string it may have one, as in `--pty=LINK`;
  /// without it the value is `bare_flag`. A number counts the uses.
  Option add_flag(const std::string& names, bool& value, const std::string& summary) const;
  Option add_flag(const std::string& names, int& count, const std::string& summary) const;
  Option add_flag(const std::string& names, std::optional<std::string>& value,
                  const std::string& summary) const;
  /// Adds a flag without effect.
  Option add_flag(const std::string& names, const std::string& summary) const;

  /// Accepts any further words, options or not, without interpreting them.
  void any_words() const;
  /// Sets the function to run after parsing a command line with this command.
  void callback(std::function<void()> run) const;
  /// Sets a paragraph after the options in help.
  void footer(const std::string& text) const;

  std::string name() const;
  std::vector<Command> commands() const;
  /// Finds `--name` or an argument by its name; nothing if there is none.
  std::optional<Option> find(const std::string& name) const;
  /// The long names of its options, without dashes.
  std::vector<std::string> option_names() const;

  CLI::App& app() const { return *app_; }

private:
  CLI::App* app_;
};

/// The value of an optional-value flag given without one.
inline constexpr auto bare_flag = "true";

} // namespace orb::cli
