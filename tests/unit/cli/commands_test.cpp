// Rules for every command of the option model.

#include "cli/commands/commands.h"
#include "cli/model/command_line.h"
#include "reference/manual.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace orb::cli {
namespace {

struct Model {
  Context context;
  std::unique_ptr<CommandLine> line = all_commands(context);
  Command orb = line->root();
  reference::CommandLine data = as_data(orb);
};

/// Returns the lines below `Examples:` in a help text.
std::vector<std::string> shown_examples(const std::string& text) {
  std::istringstream help(text);
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

bool has_option(const Command& orb, const Command& command, const std::string& name) {
  return command.find(name) || orb.find(name);
}

TEST(Commands, EveryHelpShowsTwoExamplesThatCanBePasted) {
  Model model;
  ASSERT_FALSE(model.orb.commands().empty());
  for (const auto& command : model.orb.commands()) {
    const auto name = command.name();
    const auto examples = shown_examples(model.line->parse({name, "--help"}).text);
    EXPECT_GE(examples.size(), 2U) << name;
    for (const auto& example : examples) {
      EXPECT_NE(example.find("orb " + name), std::string::npos) << example;
      // Every option in an example must exist; text after a pipe belongs to another program.
      std::istringstream words(example.substr(0, example.find('|')));
      for (std::string word; words >> word && word != "--";)
        if (word.starts_with("--")) {
          EXPECT_TRUE(has_option(model.orb, command, word.substr(0, word.find('=')))) << example;
        }
    }
  }
}

TEST(Commands, TheHelpOfOrbItselfShowsExamplesOfCommands) {
  Model model;
  const auto commands = model.orb.commands();
  const auto examples = shown_examples(model.line->help());
  EXPECT_GE(examples.size(), 2U);
  for (const auto& example : examples) {
    std::istringstream words(example);
    std::string orb;
    std::string name;
    words >> orb >> name;
    EXPECT_EQ(orb, "orb") << example;
    EXPECT_TRUE(std::any_of(commands.begin(), commands.end(), [&](const auto& command) {
      return command.name() == name;
    })) << example;
  }
}

TEST(Commands, EveryCommandHasAPageOfTheManual) {
  Model model;
  std::set<std::string> files;
  for (const auto& page : reference::manual(model.data)) {
    EXPECT_FALSE(page.text.empty()) << page.file;
    files.insert(page.file);
  }
  for (const auto& command : model.data.commands)
    EXPECT_TRUE(files.contains("orb-" + command.name + ".1")) << command.name;
  for (const auto* other : {"orb.1", "orbbasic.7", "orb-macro.7"})
    EXPECT_TRUE(files.contains(other)) << other;
}

TEST(Commands, EveryCommandAndOptionSaysWhatItDoes) {
  const Model model;
  for (const auto& command : model.data.commands) {
    EXPECT_FALSE(command.summary.empty()) << command.name;
    for (const auto& option : command.options)
      EXPECT_FALSE(option.summary.empty()) << command.name << " " << option.placeholder;
  }
}

TEST(Commands, EveryClosedListSaysWhatWasMeant) {
  for (const auto& command : Model().data.commands)
    for (const auto& option : command.options) {
      if (option.words.empty())
        continue;
      const auto misspelt = option.words.front() + "x";
      const auto word =
          option.argument.empty() ? "--" + option.long_names.front() + "=" + misspelt : misspelt;
      const auto parsed = Model().line->parse({command.name, word});
      EXPECT_NE(parsed.text.find("did you mean"), std::string::npos)
          << command.name << " " << word << ": " << parsed.text
          << " (check it by one_of, cli/model/checks.h)";
    }
}

} // namespace
} // namespace orb::cli
