#include "cli/commands.h"

#include "cli/options.h"
#include "uploader/bluez.h"
#include "vm/native/native.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <utility>

namespace orb::cli {
namespace {

std::string indent(const std::string& lines) {
  std::string out;
  for (std::size_t from = 0; from < lines.size();) {
    const auto to = std::min(lines.find('\n', from), lines.size());
    out += fmt::format("  {}\n", lines.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

/// Help with the examples first: people paste before they read.
class HelpFormatter : public CLI::Formatter {
public:
  explicit HelpFormatter(std::string examples) : examples_(std::move(examples)) {}

  std::string make_description(const CLI::App* app) const override {
    auto out = app->get_description() + "\n";
    if (!examples_.empty())
      out += "\nExamples:\n" + indent(examples_);
    return out + "\n";
  }

  const std::string& examples() const { return examples_; }

private:
  std::string examples_;
};

std::string version(const CLI::App& app) {
  auto text = fmt::format("orb {}", ORB_VERSION);
  if (app.count("--verbose") > 0) { // its variable is set only after the version is asked for
    text += vm::has_native_code() ? "\nmachine code for orbBasic: x86-64"
                                  : "\nmachine code for orbBasic: none, programs are interpreted";
    const auto no_ble = uploader::no_ble();
    text += no_ble ? "\nBluetooth LE: none; " + no_ble->seen : "\nBluetooth LE: BlueZ";
  }
  return text;
}

} // namespace

CLI::App* add_command(CLI::App& app, std::string name, std::string summary, std::string examples) {
  auto* command = app.add_subcommand(std::move(name), std::move(summary));
  command->formatter(std::make_shared<HelpFormatter>(examples + "\n"));
  command->fallthrough(); // -q, -v and --color may stand after the command
  return command;
}

std::string examples_of(const CLI::App& command) {
  const auto formatter = command.get_formatter();
  const auto* help = dynamic_cast<const HelpFormatter*>(formatter.get());
  return help == nullptr ? std::string() : help->examples();
}

namespace {

struct Command {
  std::string_view name;
  void (*add)(CLI::App&, Context&);
};

constexpr auto commands = std::to_array<Command>({
    {"abort", add_abort},
    {"asm", add_asm},
    {"ball", add_ball},
    {"build", add_build},
    {"check", add_check},
    {"commit", add_commit},
    {"completion", add_completion},
    {"dap", add_dap},
    {"debug", add_debug},
    {"decode", add_decode},
    {"disasm", add_disasm},
    {"doctor", add_doctor},
    {"drive", add_drive},
    {"encode", add_encode},
    {"erase", add_erase},
    {"exec", add_exec},
    {"explain", add_explain},
    {"fmt", add_fmt},
    {"info", add_info},
    {"lift", add_lift},
    {"lsp", add_lsp},
    {"man", add_man},
    {"monitor", add_monitor},
    {"new", add_new},
    {"ports", add_ports},
    {"run", add_run},
    {"spec", add_spec},
    {"test", add_test},
    {"upload", add_upload},
});

/// What orb is without a command.
void add_frame(CLI::App& app, Context& context) {
  app.formatter(
      std::make_shared<HelpFormatter>("orb new robot\norb check program.bas\norb run program.bas\n"
                                      "orb upload program.bas --port /dev/rfcomm0 --run\n"));
  app.require_subcommand(0, 1); // a word after a command is never a second one: `orb man run`
  app.set_version_flag(
      "--version", [&app] { return version(app); },
      "print the version and end; with -v, also what it was built with");
  app.set_help_flag("-h,--help", "print this help and exit");
  app.add_flag("-q,--quiet", context.quiet, "print nothing but results and errors");
  app.add_flag("-v,--verbose", context.verbosity, "say more; -vv traces every packet");
  app.add_option("--color", context.color, "auto, always or never")
      ->check(one_of({"auto", "always", "never"}))
      ->capture_default_str();
}

} // namespace

void add_commands(CLI::App& app, Context& context) {
  add_frame(app, context);
  for (const auto& command : commands)
    command.add(app, context);
}

bool add_only_command(CLI::App& app, Context& context, std::string_view word) {
  const auto* const command = std::find_if(commands.begin(), commands.end(),
                                           [&](const Command& one) { return one.name == word; });
  if (command == commands.end() || command->add == add_explain || command->add == add_man)
    return false; // those two tell of all commands
  add_frame(app, context);
  command->add(app, context);
  return true;
}

} // namespace orb::cli
