#include "base/suggest.h"
#include "cli/commands.h"
#include "cli/complete.h"
#include "cli/values.h"

#include <csignal>
#include <exception>
#include <fmt/format.h>

namespace {

using orb::cli::Context;
using orb::cli::ExitCode;

/// The word that CLI11 could not place, when it looks like a command or an option.
std::string unknown_word(const CLI::App& app) {
  const auto words = app.remaining(true);
  return words.empty() ? std::string() : words.front();
}

/// The names that could have been meant instead of `word`: options of the chosen command, or
/// commands.
std::vector<std::string> candidates(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  if (word.starts_with("-")) {
    for (const auto* scope :
         {&app, app.get_subcommands().empty() ? &app : app.get_subcommands().front()})
      for (const auto* option : scope->get_options())
        for (const auto& name : option->get_lnames())
          names.push_back("--" + name);
    return names;
  }
  for (const auto* command :
       app.get_subcommands([](const CLI::App* one) { return !orb::cli::is_hidden(*one); }))
    names.push_back(command->get_name());
  return names;
}

/// Prints why the command line was not understood and what was probably meant.
ExitCode report_usage(const CLI::App& app, const Context& context, const CLI::ParseError& error) {
  std::string message = error.what();
  const auto word = unknown_word(app);
  if (!word.empty()) {
    message = fmt::format("`{}` is not {} of orb", word,
                          word.starts_with("-") ? "an option" : "a command");
    const auto names = candidates(app, word.substr(0, word.find('=')));
    const std::vector<std::string_view> views(names.begin(), names.end());
    if (const auto meant = orb::closest(word.substr(0, word.find('=')), views))
      message += fmt::format("; did you mean `{}`?", *meant);
  }
  orb::cli::print_error(context, message);
  const auto chosen = app.get_subcommands();
  orb::cli::print_err(
      fmt::format("try `orb {}--help`\n", chosen.empty() ? "" : chosen.front()->get_name() + " "));
  return ExitCode::Usage;
}

tl::expected<void, orb::cli::ConfigError> configure(CLI::App& app, Context& context) {
  auto config = orb::cli::load_config();
  if (!config)
    return tl::unexpected(config.error());
  context.config = *std::move(config);
  return orb::cli::apply_config(context.config, app);
}

/// Answers a completion script. A broken configuration costs the named balls, nothing else.
void answer_completion(const CLI::App& app, std::vector<std::string> words) {
  if (!words.empty() && words.front() == "--")
    words.erase(words.begin());
  const auto config = orb::cli::load_config().value_or(orb::cli::Config());
  orb::cli::print_out(print(complete(app, config, words)));
}

int run(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN); // a closed pipe or socket is an error to handle, not a death
  CLI::App app(
      "orb writes, checks, runs and flashes orbBasic programs and macros for Sphero robots.",
      "orb");
  Context context;
  orb::cli::add_commands(app, context);
  if (argc == 1) {
    orb::cli::print_out(app.help());
    return 0;
  }
  if (argv[1] == orb::cli::completion_request) {
    answer_completion(app, std::vector<std::string>(argv + 2, argv + argc));
    return 0;
  }
  if (const auto ready = configure(app, context); !ready) {
    orb::cli::print_error(context, ready.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) { // --help and --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(report_usage(app, context, error));
  }
  return static_cast<int>(context.exit);
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    orb::cli::print_err(fmt::format(
        "orb: internal error: {}\nthis is a bug in orb; please report it with the command line\n",
        error.what()));
    return static_cast<int>(ExitCode::Bug);
  }
}
