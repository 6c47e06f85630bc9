// Replaces the commands that ./dev demo leaves out of the program that it builds first: with their
// dependencies they are more than half of the code.

#include "cli/commands/commands.h"
#include "cli/editors/commands.h"

#include <fmt/format.h>
#include <string>

namespace orb::cli {
namespace {

void add_left_out(const Command& orb, Context& context, const std::string& name) {
  const auto command = orb.add_command(
      name, "left out by ./dev demo; ./dev build orb builds the full program", "./dev build orb");
  command.any_words();
  command.callback([&context, name] {
    print_error(context, fmt::format("`orb {}` is left out of this program, which `./dev demo` "
                                     "built; `./dev build orb` builds the full one",
                                     name));
    context.exit = ExitCode::Usage;
  });
}

} // namespace

#define LEFT_OUT(name)                                                                             \
  void add_##name(const Command& orb, Context& context) {                                          \
    add_left_out(orb, context, #name);                                                             \
  }
LEFT_OUT(abort)
LEFT_OUT(calibrate)
LEFT_OUT(commit)
LEFT_OUT(completion)
LEFT_OUT(dap)
LEFT_OUT(debug)
LEFT_OUT(decode)
LEFT_OUT(disasm)
LEFT_OUT(doctor)
LEFT_OUT(drive)
LEFT_OUT(encode)
LEFT_OUT(erase)
LEFT_OUT(exec)
LEFT_OUT(fmt)
LEFT_OUT(info)
LEFT_OUT(lift)
LEFT_OUT(lsp)
LEFT_OUT(man)
LEFT_OUT(spec)
LEFT_OUT(test)
#undef LEFT_OUT

} // namespace orb::cli
