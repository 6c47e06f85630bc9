#pragma once

#include "cli/context.h"

#include <CLI/CLI.hpp>
#include <string_view>

namespace orb::cli {

/// Builds the whole option model: every command with its options, help and examples. Parsing it
/// runs the chosen command, which leaves its exit code in `context`. Completion and the man pages
/// are printed from the same model.
void add_commands(CLI::App& app, Context& context);

/// Builds the model with the one command of that name, which takes a tenth of the time; false where
/// there is none, or where it needs all of them.
bool add_only_command(CLI::App& app, Context& context, std::string_view word);

// One function per command, each in the file of its name. It adds the subcommand to `app`.
void add_abort(CLI::App& app, Context& context);
void add_asm(CLI::App& app, Context& context);
void add_ball(CLI::App& app, Context& context);
void add_build(CLI::App& app, Context& context);
void add_check(CLI::App& app, Context& context);
void add_commit(CLI::App& app, Context& context);
void add_completion(CLI::App& app, Context& context);
void add_dap(CLI::App& app, Context& context);
void add_debug(CLI::App& app, Context& context);
void add_drive(CLI::App& app, Context& context);
void add_decode(CLI::App& app, Context& context);
void add_disasm(CLI::App& app, Context& context);
void add_doctor(CLI::App& app, Context& context);
void add_encode(CLI::App& app, Context& context);
void add_erase(CLI::App& app, Context& context);
void add_exec(CLI::App& app, Context& context);
void add_explain(CLI::App& app, Context& context);
void add_fmt(CLI::App& app, Context& context);
void add_info(CLI::App& app, Context& context);
void add_lift(CLI::App& app, Context& context);
void add_lsp(CLI::App& app, Context& context);
void add_man(CLI::App& app, Context& context);
void add_monitor(CLI::App& app, Context& context);
void add_new(CLI::App& app, Context& context);
void add_ports(CLI::App& app, Context& context);
void add_run(CLI::App& app, Context& context);
void add_spec(CLI::App& app, Context& context);
void add_test(CLI::App& app, Context& context);
void add_upload(CLI::App& app, Context& context);

/// Adds a command. `examples` are pasted lines, one per line, printed first in its help.
CLI::App* add_command(CLI::App& app, std::string name, std::string summary, std::string examples);

/// The examples of a command, or of orb itself, a line each.
std::string examples_of(const CLI::App& command);

} // namespace orb::cli
