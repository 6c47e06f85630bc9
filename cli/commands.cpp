#include "cli/commands.h"

#include "cli/options.h"
#include "vm/native.h"

#include <fmt/format.h>
#include <memory>
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
  if (app.count("--verbose") > 0) // its variable is set only after the version is asked for
    text += vm::has_native_code() ? "\nmachine code for orbBasic: x86-64"
                                  : "\nmachine code for orbBasic: none, programs are interpreted";
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

void add_commands(CLI::App& app, Context& context) {
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
  add_abort(app, context);
  add_asm(app, context);
  add_ball(app, context);
  add_build(app, context);
  add_check(app, context);
  add_commit(app, context);
  add_completion(app, context);
  add_decode(app, context);
  add_disasm(app, context);
  add_doctor(app, context);
  add_encode(app, context);
  add_erase(app, context);
  add_exec(app, context);
  add_explain(app, context);
  add_fmt(app, context);
  add_info(app, context);
  add_lift(app, context);
  add_lsp(app, context);
  add_man(app, context);
  add_monitor(app, context);
  add_new(app, context);
  add_ports(app, context);
  add_run(app, context);
  add_spec(app, context);
  add_test(app, context);
  add_upload(app, context);
}

} // namespace orb::cli
