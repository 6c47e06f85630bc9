#include "cli/commands.h"

#include <memory>

namespace orb::cli {

void add_explain(CLI::App& app, Context& context) {
  auto* command = add_command(app, "explain", "everything the tables know about a word",
                              "orb explain goroll\norb explain unknown-statement");
  auto word = std::make_shared<std::string>();
  command->add_option("WORD", *word, "a rule, statement, error or command")->required();
  command->callback([&context, word] {
    print_error(context, "nothing is known about `" + *word + "`");
    context.exit = ExitCode::BadInput;
  });
}

} // namespace orb::cli
