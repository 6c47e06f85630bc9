#include "cli/commands/commands.h"
#include "cli/context/language.h"
#include "cli/editors/commands.h"
#include "cli/model/command_line.h"

#include "uploader/bluez.h"
#include "vm/machine/native/native.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <utility>

namespace orb::cli {
namespace {

std::string version(const Command& orb) {
  auto text = fmt::format("orb {}", ORB_VERSION);
  if (orb.find("--verbose")->given()) { // --version is handled before the option's variable is set
    text += vm::has_native_code() ? "\nmachine code for orbBasic: x86-64"
                                  : "\nmachine code for orbBasic: none; programs are interpreted";
    const auto no_ble = uploader::no_ble();
    text += no_ble ? "\nBluetooth LE: none; " + no_ble->seen : "\nBluetooth LE: BlueZ";
  }
  return text;
}

struct CommandRow {
  std::string_view name;
  void (*add)(const Command&, Context&);
};

constexpr auto commands = std::to_array<CommandRow>({
    {"abort", add_abort},
    {"asm", add_asm},
    {"ball", add_ball},
    {"build", add_build},
    {"calibrate", add_calibrate},
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

/// Makes the command line of orb without its commands.
std::unique_ptr<CommandLine> frame(Context& context) {
  auto line = std::make_unique<CommandLine>(
      "orb", "orb writes, checks, runs and flashes orbBasic programs and macros for Sphero robots.",
      "orb new robot\norb check program.bas\norb run program.bas\n"
      "orb upload program.bas --port /dev/rfcomm0 --run\n");
  const auto orb = line->root();
  line->add_help_and_version([orb] { return version(orb); },
                             "print the version and exit; with -v, also what it was built with");
  orb.add_flag("-q,--quiet", context.quiet, "print nothing but results and errors");
  orb.add_flag("-v,--verbose", context.verbosity, "say more; -vv traces every packet");
  orb.add_option("--color", context.color, "auto, always or never")
      .check(one_of({"auto", "always", "never"}))
      .show_default();
  orb.add_option(
         "--lang-ui", context.ui_language,
         "language of findings and verdicts; by default that of LC_ALL, LC_MESSAGES or LANG")
      .check(one_of(ui_languages()));
  return line;
}

} // namespace

std::unique_ptr<CommandLine> all_commands(Context& context) {
  auto line = frame(context);
  for (const auto& row : commands)
    row.add(line->root(), context);
  return line;
}

std::unique_ptr<CommandLine> only_command(Context& context, std::string_view word) {
  const auto* const row = std::find_if(commands.begin(), commands.end(),
                                       [&](const CommandRow& one) { return one.name == word; });
  if (row == commands.end() || row->add == add_explain || row->add == add_man)
    return nullptr; // these two describe all commands
  auto line = frame(context);
  row->add(line->root(), context);
  return line;
}

} // namespace orb::cli
