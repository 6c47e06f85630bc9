// What holds for every command of the option model.

#include "cli/commands.h"
#include "cli/options.h"
#include "reference/manual.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <utility>

namespace orb::cli {
namespace {

struct Model {
  CLI::App app{"", "orb"};
  Context context;
  std::vector<const CLI::App*> commands;

  Model() {
    add_commands(app, context);
    commands = std::as_const(app).get_subcommands(
        [](const CLI::App* command) { return !is_hidden(*command); });
  }
};

/// The lines below `Examples:` in the help of a command: what a user sees.
std::vector<std::string> shown_examples(const CLI::App& command) {
  std::istringstream help(command.help());
  std::vector<std::string> examples;
  bool inside = false;
  for (std::string line; std::getline(help, line);) {
    if (inside && line.empty())
      break;
    if (inside)
      examples.push_back(line);
    inside = inside || line == "Examples:";
  }
  return examples;
}

bool has_option(const CLI::App& app, const CLI::App& command, const std::string& name) {
  return command.get_option_no_throw(name) != nullptr || app.get_option_no_throw(name) != nullptr;
}

TEST(Commands, EveryHelpShowsTwoExamplesThatCanBePasted) {
  Model model;
  ASSERT_FALSE(model.commands.empty());
  for (const auto* command : model.commands) {
    const auto examples = shown_examples(*command);
    EXPECT_GE(examples.size(), 2U) << command->get_name();
    for (const auto& example : examples) {
      EXPECT_NE(example.find("orb " + command->get_name()), std::string::npos) << example;
      // Every option in it exists; what stands after a pipe belongs to another program.
      std::istringstream words(example.substr(0, example.find('|')));
      for (std::string word; words >> word && word != "--";)
        if (word.starts_with("--")) {
          EXPECT_TRUE(has_option(model.app, *command, word.substr(0, word.find('=')))) << example;
        }
    }
  }
}

TEST(Commands, TheHelpOfOrbItselfShowsExamplesOfCommands) {
  Model model;
  const auto examples = shown_examples(model.app);
  EXPECT_GE(examples.size(), 2U);
  for (const auto& example : examples) {
    std::istringstream words(example);
    std::string orb;
    std::string name;
    words >> orb >> name;
    EXPECT_EQ(orb, "orb") << example;
    EXPECT_TRUE(std::any_of(model.commands.begin(), model.commands.end(), [&](const auto* command) {
      return command->get_name() == name;
    })) << example;
  }
}

TEST(Commands, EveryCommandHasAPageOfTheManual) {
  Model model;
  std::set<std::string> files;
  for (const auto& page : reference::manual(command_line(model.app))) {
    EXPECT_FALSE(page.text.empty()) << page.file;
    files.insert(page.file);
  }
  for (const auto* command : model.commands)
    EXPECT_TRUE(files.contains("orb-" + command->get_name() + ".1")) << command->get_name();
  for (const auto* other : {"orb.1", "orbbasic.7", "orb-macro.7"})
    EXPECT_TRUE(files.contains(other)) << other;
}

TEST(Commands, EveryCommandAndOptionSaysWhatItDoes) {
  Model model;
  for (const auto* command : model.commands) {
    EXPECT_FALSE(command->get_description().empty()) << command->get_name();
    for (const auto* option : command->get_options())
      EXPECT_FALSE(option->get_description().empty())
          << command->get_name() << " " << option->get_name();
  }
}

TEST(Commands, EveryClosedListSaysWhatWasMeant) {
  Model model;
  for (const auto& command : command_line(model.app).commands)
    for (const auto& option : command.options) {
      if (option.words.empty())
        continue;
      const auto name =
          option.argument.empty() ? "--" + option.long_names.front() : option.argument;
      auto* check = model.app.get_subcommand(command.name)->get_option(name)->get_validator(0);
      auto misspelt = option.words.front() + "x";
      const auto message = (*check)(misspelt);
      EXPECT_NE(message.find("did you mean"), std::string::npos)
          << command.name << " " << name << ": " << message
          << " (check it by one_of, cli/options.h)";
    }
}

} // namespace
} // namespace orb::cli
