#pragma once

#include "cli/model/checks.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

// The option model, without what parses it: the header of CLI11 takes seconds to compile, so only
// the files of this folder see it.
namespace CLI {
class App;
class Option;
} // namespace CLI

namespace orb::cli {

/// An option or an argument while it is described. A handle: copies mean the same option.
class Option {
public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option check(const Check& check) const;
  /// The same for a check that help says nothing of.
  Option check(std::function<std::string(const std::string&)> problem) const;
  /// What its value is called in help: `FILE`.
  Option type_name(const std::string& name) const;
  Option required() const;
  /// Help shows the value that its variable has now.
  Option show_default() const;
  Option show_default(const std::string& value) const;
  /// Both together are an error.
  Option excludes(const Option& other) const;
  /// Without the other one it is an error.
  Option needs(const Option& other) const;
  /// A variable of the environment gives it, too; the command line wins.
  Option environment(const std::string& name) const;
  /// Each use takes one value: words after it are arguments.
  Option one_value_each() const;
  /// May stand without a value; takes one only as `--option=value`.
  Option value_optional() const;
  /// One word may hold several values.
  Option separated_by(char separator) const;

  /// Whether the command line has it.
  bool given() const;
  /// Gives it values as if from the command line, which still replaces them; why it cannot be given
  /// these, if so.
  std::optional<std::string> set_default(const std::vector<std::string>& values) const;

private:
  friend class Command;
  CLI::Option* option_;
};

/// A command of orb, or orb itself, while it is described. A handle: copies mean the same command.
class Command {
public:
  explicit Command(CLI::App& app) : app_(&app) {}

  /// Adds a command. `examples` are pasted lines, one per line, printed first in its help.
  Command add_command(const std::string& name, const std::string& summary,
                      const std::string& examples) const;

  /// Adds an option (`-o,--out`) or an argument (`FILE`), whose value goes to `value` when the
  /// command line has been read. For strings, numbers and vectors of them (command.cpp).
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& summary) const;
  /// The same with a function that takes the value.
  Option add_option(const std::string& names, std::function<void(const std::string&)> take,
                    const std::string& summary) const;

  /// Adds an option without a value. With an optional text it may be given one: `--pty=LINK`, and
  /// is `bare_flag` without. A number counts how often it stands.
  Option add_flag(const std::string& names, bool& value, const std::string& summary) const;
  Option add_flag(const std::string& names, int& count, const std::string& summary) const;
  Option add_flag(const std::string& names, std::optional<std::string>& value,
                  const std::string& summary) const;
  /// One that changes nothing.
  Option add_flag(const std::string& names, const std::string& summary) const;

  /// Takes whatever words follow, options or not, and leaves them unread.
  void any_words() const;
  /// What runs when the command line has named the command and been read.
  void callback(std::function<void()> run) const;
  /// A paragraph after the options in help.
  void footer(const std::string& text) const;

  std::string name() const;
  std::vector<Command> commands() const;
  /// `--name` or an argument's name; nothing where there is none.
  std::optional<Option> find(const std::string& name) const;
  /// The long names of its options, without dashes.
  std::vector<std::string> option_names() const;

  CLI::App& app() const { return *app_; }

private:
  CLI::App* app_;
};

/// The value of a flag that takes one, where it stands without.
inline constexpr auto bare_flag = "true";

} // namespace orb::cli
