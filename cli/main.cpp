#include "base/contain.h"
#include "cli/commands/commands.h"
#include "cli/commands/robot/ports.h"
#include "cli/context/console.h"
#include "cli/context/output_error.h"
#include "cli/model/command_line.h"
#include "reference/completion_words.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using orb::ExitCode;
using orb::cli::Context;
using orb::cli::Parsed;

/// The word that completion scripts begin with: `orb __complete -- WORDS`. It is not a command of
/// the option model, because the words after it are data, not options.
constexpr std::string_view completion_request = "__complete";

/// Answers a completion script. A broken configuration only loses the named balls.
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

/// Runs a command line with only its own command's options loaded. Nothing if all commands are
/// needed: to check settings, or for a line that does not parse.
std::optional<int> run_only_command(const orb::cli::Config& config,
                                    const std::vector<std::string>& words) {
  if (!config.settings.empty())
    return std::nullopt;
  Context context;
  context.config = config;
  const auto line = orb::cli::only_command(context, words[1]);
  if (line == nullptr || line->parse({words.begin() + 1, words.end()}).kind != Parsed::Kind::Ran)
    return std::nullopt;
  return static_cast<int>(context.exit);
}

int run_command(orb::cli::CommandLine& line, Context& context,
                const std::vector<std::string>& words) {
  if (const auto ready = orb::cli::apply_config(context.config, line.root()); !ready) {
    orb::cli::print_error(context, ready.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  const auto parsed = line.parse({words.begin() + 1, words.end()});
  switch (parsed.kind) {
  case Parsed::Kind::Ran: break;
  case Parsed::Kind::Help: orb::cli::print_out(parsed.text); return 0;
  case Parsed::Kind::Misread:
    orb::cli::print_error(context, parsed.text);
    orb::cli::print_err(
        fmt::format("try `orb {}{}--help`\n", parsed.command, parsed.command.empty() ? "" : " "));
    return static_cast<int>(ExitCode::Usage);
  }
  return static_cast<int>(context.exit);
}

int run(const std::vector<std::string>& words) {
  const bool completes = words.size() > 1 && words[1] == completion_request;
  const auto config = words.size() == 1 || completes ? orb::cli::Config() : orb::cli::load_config();
  if (config && words.size() > 1)
    if (const auto exit = run_only_command(*config, words))
      return *exit;
  Context context;
  const auto line = orb::cli::all_commands(context);
  if (words.size() == 1) {
    orb::cli::print_out(line->help());
    return 0;
  }
  if (completes) {
    answer_completion(*line, {words.begin() + 2, words.end()});
    return 0;
  }
  if (!config) {
    orb::cli::print_error(context, config.error().message);
    return static_cast<int>(ExitCode::Usage);
  }
  context.config = *config;
  return run_command(*line, context, words);
}

/// Ends silently if the reader has left, as other programs do; else reports why output is
/// impossible.
int end_without_output(int error) {
  if (error == EINTR) // Ctrl-C, while the reader goes on
    return static_cast<int>(ExitCode::Interrupted);
  orb::cli::end_if_unread(error);
  orb::cli::print_err(fmt::format("orb: error: cannot write <stdout>: {}\n", std::strerror(error)));
  return static_cast<int>(ExitCode::File);
}

} // namespace

int main(int argc, char** argv) {
  try {
    const auto exit = orb::contain([&]() -> tl::expected<int, orb::Failure> {
      return run(orb::cli::begin_process(argc, argv));
    });
    if (exit)
      return *exit;
    orb::cli::print_err(fmt::format("orb: error: {}\n", exit.error().message));
    return static_cast<int>(exit.error().code);
  } catch (const orb::cli::OutputError& failure) {
    return end_without_output(failure.error);
  }
}
