#include "cli/model/command_line.h"

#include "cli/model/help.h"
#include "run/input.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <sstream>
#include <utility>

namespace orb::cli {
namespace {

/// The word that CLI11 could not place, if it looks like a command or an option.
std::string unknown_word(const CLI::App& app) {
  const auto words = app.remaining(true);
  return words.empty() ? std::string() : words.front();
}

/// The command on the command line; null if there is none.
CLI::App* chosen_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

std::vector<std::string> option_names(CLI::App& app) {
  std::vector<std::string> names;
  for (auto* scope : {chosen_command(app), &app})
    if (scope != nullptr)
      for (const auto& name : Command(*scope).option_names())
        names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(CLI::App& app) {
  std::vector<std::string> names;
  for (const auto& command : Command(app).commands())
    names.push_back(command.name());
  return names;
}

/// Why `word` is not allowed in its place, and what was probably meant.
std::string describe_word(CLI::App& app, const std::string& word) {
  const auto* command = chosen_command(app);
  const auto whom = command == nullptr ? std::string("orb") : "orb " + command->get_name();
  if (word.starts_with("-")) {
    const auto name = word.substr(0, word.find('='));
    return fmt::format("`{}` is not an option of {}{}", name, whom,
                       meant_instead(name, option_names(app)));
  }
  if (command != nullptr)
    return fmt::format("unexpected argument `{}` for {}", word, whom);
  if (run::content_of(word, ""))
    return fmt::format("`{0}` is not an orb command; to run it, write `orb run {0}`", word);
  return fmt::format("`{}` is not an orb command{}", word, meant_instead(word, command_names(app)));
}

/// Moves options with optional values behind the other words, unless a file could be taken for the
/// value: they take one only as `--option=value`.
void move_bare_options(const CLI::App& app, std::vector<std::string>& words) {
  const CLI::App* command = nullptr;
  auto first = words.end();
  for (const auto* known : app.get_subcommands([](const CLI::App*) { return true; }))
    if (const auto at = std::find(words.begin(), first, known->get_name()); at != first) {
      first = at;
      command = known;
    }
  if (command == nullptr)
    return;
  const auto is_bare = [&](const std::string& word) {
    const auto* option =
        !word.starts_with("--") || word == "--" ? nullptr : command->get_option_no_throw(word);
    return option != nullptr && option->get_items_expected_min() == 0 &&
           option->get_items_expected_max() > 0;
  };
  const auto end = std::find(words.begin(), words.end(), "--");
  std::stable_partition(words.begin(), end, [&](const auto& word) { return !is_bare(word); });
}

std::string indent(const std::string& lines) {
  std::string out;
  for (std::size_t from = 0; from < lines.size();) {
    const auto to = std::min(lines.find('\n', from), lines.size());
    out += fmt::format("  {}\n", lines.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

} // namespace

std::string HelpFormatter::make_description(const CLI::App* app) const {
  auto out = app->get_description() + "\n";
  if (!examples_.empty())
    out += "\nExamples:\n" + indent(examples_);
  return out + "\n";
}

CommandLine::CommandLine(const std::string& name, const std::string& about,
                         const std::string& examples)
    : app_(std::make_unique<CLI::App>(about, name)) {
  app_->allow_windows_style_options(false); // `/tmp/a.bas` is a path on Windows, too
  app_->formatter(std::make_shared<HelpFormatter>(examples));
  app_->require_subcommand(0, 1); // a word after a command is never a second command: `orb man run`
}

CommandLine::~CommandLine() = default;

void CommandLine::add_help_and_version(std::function<std::string()> version,
                                       const std::string& summary) {
  app_->set_version_flag("--version", std::move(version), summary);
  app_->set_help_flag("-h,--help", "print this help and exit");
}

Parsed CommandLine::parse(std::vector<std::string> words) {
  move_bare_options(*app_, words);
  std::reverse(words.begin(), words.end()); // CLI11 expects the last word first
  const auto command = [&] {
    const auto* chosen = chosen_command(*app_);
    return chosen == nullptr ? std::string() : chosen->get_name();
  };
  try {
    app_->parse(std::move(words));
  } catch (const CLI::Success& success) { // --help and --version
    std::ostringstream text;
    app_->exit(success, text, text);
    return {Parsed::Kind::Help, text.str(), command()};
  } catch (const CLI::ParseError& error) {
    const auto word = unknown_word(*app_);
    return {Parsed::Kind::Misread, word.empty() ? error.what() : describe_word(*app_, word),
            command()};
  }
  return {Parsed::Kind::Ran, {}, command()};
}

std::string CommandLine::help() const {
  return app_->help();
}

} // namespace orb::cli
