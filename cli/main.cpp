#include "cli/commands/commands.h"
#include "cli/commands/robot/ports.h"
#include "cli/context/output_error.h"
#include "cli/model/command_line.h"
#include "reference/completion_words.h"

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
using orb::cli::Parsed;

/// The first word of a command line by which the completion scripts ask: `orb __complete -- WORDS`.
/// It is not a command of the option model, because the words after it are data, not options.
constexpr std::string_view completion_request = "__complete";

/// Answers a completion script. A broken configuration costs the named balls, nothing else.
void answer_completion(const orb::cli::CommandLine& line, std::vector<std::string> words) {
  if (!words.empty() && words.front() == "--")
    words.erase(words.begin());
  const auto config = orb::cli::load_config().value_or(orb::cli::Config());
  std::vector<orb::reference::Candidate> ports;
  for (auto& port : orb::cli::find_ports(config))
    ports.push_back({std::move(port.url), std::move(port.what)});
  for (const auto& [name, group] : config.groups)
    ports.push_back({"@" + name, fmt::format("{} robots", group.members.size())});
  orb::cli::print_out(print(complete(as_data(line.root()), ports, words)));
}

/// Runs a command line that begins with a command, with nothing but that command's options; nothing
/// where all of them are needed: to make sense of settings, or of a line that does not parse.
std::optional<int> run_only_command(const orb::cli::Config& config, int argc, char** argv) {
  if (!config.settings.empty())
    return std::nullopt;
  Context context;
  context.config = config;
  const auto line = orb::cli::only_command(context, argv[1]);
  if (line == nullptr || line->parse({argv + 1, argv + argc}).kind != Parsed::Kind::Ran)
    return std::nullopt;
  return static_cast<int>(context.exit);
}

int run_command(orb::cli::CommandLine& line, Context& context, int argc, char** argv) {
  if (const auto ready = orb::cli::apply_config(context.config, line.root()); !ready) {
    orb::cli::print_error(context, ready.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  const auto parsed = line.parse({argv + 1, argv + argc});
  switch (parsed.kind) {
  case Parsed::Kind::Ran: break;
  case Parsed::Kind::Told: orb::cli::print_out(parsed.text); return 0;
  case Parsed::Kind::Misread:
    orb::cli::print_error(context, parsed.text);
    orb::cli::print_err(
        fmt::format("try `orb {}{}--help`\n", parsed.command, parsed.command.empty() ? "" : " "));
    return static_cast<int>(ExitCode::Usage);
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
  Context context;
  const auto line = orb::cli::all_commands(context);
  if (argc == 1) {
    orb::cli::print_out(line->help());
    return 0;
  }
  if (completes) {
    answer_completion(*line, std::vector<std::string>(argv + 2, argv + argc));
    return 0;
  }
  if (!config) {
    orb::cli::print_error(context, config.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  context.config = *config;
  return run_command(*line, context, argc, argv);
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
