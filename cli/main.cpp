#include "cli/commands.h"
#include "cli/commands/robot/ports.h"
#include "cli/options.h"
#include "cli/output_error.h"
#include "reference/completion_words.h"
#include "run/input.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <system_error>
#include <unistd.h>

namespace {

using orb::ExitCode;
using orb::cli::Context;

/// The first word of a command line by which the completion scripts ask: `orb __complete -- WORDS`.
/// It is not a command of the option model, because the words after it are data, not options.
constexpr std::string_view completion_request = "__complete";

/// The word that CLI11 could not place, when it looks like a command or an option.
std::string unknown_word(const CLI::App& app) {
  const auto words = app.remaining(true);
  return words.empty() ? std::string() : words.front();
}

/// The command that the command line names; null where it names none.
const CLI::App* chosen_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* scope : {chosen_command(app), &app})
    if (scope != nullptr)
      for (const auto* option : scope->get_options())
        for (const auto& name : option->get_lnames())
          names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* command :
       app.get_subcommands([](const CLI::App* one) { return !orb::cli::is_hidden(*one); }))
    names.push_back(command->get_name());
  return names;
}

/// Why `word` has no place where it stands, and what was probably meant.
std::string describe(const CLI::App& app, const std::string& word) {
  const auto* command = chosen_command(app);
  const auto whom = command == nullptr ? std::string("orb") : "orb " + command->get_name();
  if (word.starts_with("-")) {
    const auto name = word.substr(0, word.find('='));
    return fmt::format("`{}` is not an option of {}{}", name, whom,
                       orb::cli::meant_instead(name, option_names(app)));
  }
  if (command != nullptr)
    return fmt::format("`{}` is one word too many for {}", word, whom);
  if (orb::run::content_of(word, ""))
    return fmt::format("`{0}` is not a command of orb; to run it, write `orb run {0}`", word);
  return fmt::format("`{}` is not a command of orb{}", word,
                     orb::cli::meant_instead(word, command_names(app)));
}

/// Prints why the command line was not understood and what was probably meant.
ExitCode report_usage(const CLI::App& app, const Context& context, const CLI::ParseError& error) {
  const auto word = unknown_word(app);
  orb::cli::print_error(context, word.empty() ? error.what() : describe(app, word));
  const auto* command = chosen_command(app);
  orb::cli::print_err(
      fmt::format("try `orb {}--help`\n", command == nullptr ? "" : command->get_name() + " "));
  return ExitCode::Usage;
}

/// The words of the command line, last first as CLI11 takes them. An option whose value is optional
/// takes it only as `--option=value`: a bare one is moved after all others, where there is no file
/// that it could take for its value.
std::vector<std::string> words_for(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const CLI::App* command = nullptr;
  for (const auto* known : app.get_subcommands([](const CLI::App*) { return true; }))
    if (std::find(words.begin(), words.end(), known->get_name()) != words.end() &&
        (command == nullptr || std::find(words.begin(), words.end(), known->get_name()) <
                                   std::find(words.begin(), words.end(), command->get_name())))
      command = known;
  const auto is_bare = [&](const std::string& word) {
    const auto* option = command == nullptr || !word.starts_with("--") || word == "--"
                             ? nullptr
                             : command->get_option_no_throw(word);
    return option != nullptr && option->get_items_expected_min() == 0 &&
           option->get_items_expected_max() > 0;
  };
  const auto end = std::find(words.begin(), words.end(), "--");
  std::stable_partition(words.begin(), end, [&](const auto& word) { return !is_bare(word); });
  std::reverse(words.begin(), words.end());
  return words;
}

/// Answers a completion script. A broken configuration costs the named balls, nothing else.
void answer_completion(const CLI::App& app, std::vector<std::string> words) {
  if (!words.empty() && words.front() == "--")
    words.erase(words.begin());
  const auto config = orb::cli::load_config().value_or(orb::cli::Config());
  std::vector<orb::reference::Candidate> ports;
  for (auto& port : orb::cli::find_ports(config))
    ports.push_back({std::move(port.url), std::move(port.what)});
  orb::cli::print_out(print(complete(orb::cli::command_line(app), ports, words)));
}

constexpr auto about =
    "orb writes, checks, runs and flashes orbBasic programs and macros for Sphero robots.";

/// Runs a command line that begins with a command, with nothing but that command's options; nothing
/// where all of them are needed: to make sense of settings, or of a line that does not parse.
std::optional<int> run_only_command(const orb::cli::Config& config, int argc, char** argv) {
  if (!config.settings.empty())
    return std::nullopt;
  CLI::App app(about, "orb");
  Context context;
  context.config = config;
  if (!orb::cli::add_only_command(app, context, argv[1]))
    return std::nullopt;
  try {
    app.parse(words_for(app, argc, argv));
  } catch (const CLI::Error&) { // nothing has run
    return std::nullopt;
  }
  return static_cast<int>(context.exit);
}

int run_command(CLI::App& app, Context& context, int argc, char** argv) {
  if (const auto ready = orb::cli::apply_config(context.config, app); !ready) {
    orb::cli::print_error(context, ready.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  try {
    app.parse(words_for(app, argc, argv));
  } catch (const CLI::Success& success) { // --help and --version
    std::ostringstream text;
    const int code = app.exit(success, text, text);
    orb::cli::print_out(text.str());
    return code;
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(report_usage(app, context, error));
  }
  return static_cast<int>(context.exit);
}

int run(int argc, char** argv) {
  // A closed pipe or socket, or a file as large as it may be, is an error to handle, not a death.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const bool completes = argc > 1 && argv[1] == completion_request;
  const auto config = argc == 1 || completes ? orb::cli::Config() : orb::cli::load_config();
  if (config && argc > 1)
    if (const auto exit = run_only_command(*config, argc, argv))
      return *exit;
  CLI::App app(about, "orb");
  Context context;
  orb::cli::add_commands(app, context);
  if (argc == 1) {
    orb::cli::print_out(app.help());
    return 0;
  }
  if (completes) {
    answer_completion(app, std::vector<std::string>(argv + 2, argv + argc));
    return 0;
  }
  if (!config) {
    orb::cli::print_error(context, config.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  context.config = *config;
  return run_command(app, context, argc, argv);
}

/// Ends as every program does whose reader has left, without a word; else says why nothing can be
/// written.
int end_without_output(int error) {
  if (error == EINTR) // Ctrl-C, while whoever reads did not
    return static_cast<int>(ExitCode::Interrupted);
  if (error == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  orb::cli::print_err(fmt::format("orb: error: cannot write <stdout>: {}\n", std::strerror(error)));
  return static_cast<int>(ExitCode::File);
}

/// Keeps a closed stdin, stdout or stderr from being the next file or socket that is opened, where
/// what is printed would then go. Reading and writing it stay errors.
void keep_standard_streams_apart() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(fd, F_GETFD) < 0)
      static_cast<void>(::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

} // namespace

int main(int argc, char** argv) {
  keep_standard_streams_apart();
  try {
    return run(argc, argv);
  } catch (const orb::cli::OutputError& failure) {
    return end_without_output(failure.error);
  } catch (const std::system_error& error) { // no descriptor left, say
    orb::cli::print_err(fmt::format("orb: error: {}\n", error.what()));
    return static_cast<int>(ExitCode::File);
  } catch (const std::exception& error) {
    orb::cli::print_err(fmt::format(
        "orb: internal error: {}\nthis is a bug in orb; please report it with the command line\n",
        error.what()));
    return static_cast<int>(ExitCode::Bug);
  }
}
