// Stands for the rest of this folder in the program that ./dev demo builds first: the editors'
// rooms and the debugger are a quarter of what there is to compile, and the demo shows neither.

#include "cli/editors/commands.h"
#include "cli/editors/word_lists.h"

#include <fmt/format.h>
#include <string>

namespace orb::cli {
namespace {

void say_left_out(Context& context, const std::string& command) {
  print_error(context, fmt::format("`{}` is left out of this program, which `./dev demo` "
                                   "built; `./dev build orb` builds the full one",
                                   command));
  context.exit = ExitCode::Usage;
}

void add_left_out(const Command& orb, Context& context, const std::string& name) {
  const auto command = orb.add_command(
      name, "left out by ./dev demo; ./dev build orb builds the full program", "./dev build orb");
  command.any_words();
  command.callback([&context, name] { say_left_out(context, "orb " + name); });
}

} // namespace

void add_dap(const Command& orb, Context& context) {
  add_left_out(orb, context, "dap");
}

void add_debug(const Command& orb, Context& context) {
  add_left_out(orb, context, "debug");
}

void add_lsp(const Command& orb, Context& context) {
  add_left_out(orb, context, "lsp");
}

void write_editor_files(Context& context, const std::string& /*folder*/) {
  say_left_out(context, "orb spec --editors");
}

} // namespace orb::cli
