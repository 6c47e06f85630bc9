#pragma once

#include "cli/context/context.h"
#include "cli/model/command.h"

#include <memory>
#include <string_view>

namespace orb::cli {

class CommandLine;

/// The command line of orb with every command, its options, help and examples. Parsing runs the
/// chosen command, which puts its exit code into `context`. Completion and the man pages are
/// generated from the same model.
std::unique_ptr<CommandLine> all_commands(Context& context);

/// The same with only one command, built in a tenth of the time. Null if the command does not exist
/// or needs the others.
std::unique_ptr<CommandLine> only_command(Context& context, std::string_view word);

// One function per command, each in the file of the same name. It adds the command to `orb`.
void add_abort(const Command& orb, Context& context);
void add_asm(const Command& orb, Context& context);
void add_ball(const Command& orb, Context& context);
void add_build(const Command& orb, Context& context);
void add_calibrate(const Command& orb, Context& context);
void add_check(const Command& orb, Context& context);
void add_commit(const Command& orb, Context& context);
void add_completion(const Command& orb, Context& context);
void add_drive(const Command& orb, Context& context);
void add_decode(const Command& orb, Context& context);
void add_disasm(const Command& orb, Context& context);
void add_doctor(const Command& orb, Context& context);
void add_encode(const Command& orb, Context& context);
void add_erase(const Command& orb, Context& context);
void add_exec(const Command& orb, Context& context);
void add_explain(const Command& orb, Context& context);
void add_fmt(const Command& orb, Context& context);
void add_info(const Command& orb, Context& context);
void add_lift(const Command& orb, Context& context);
void add_man(const Command& orb, Context& context);
void add_monitor(const Command& orb, Context& context);
void add_new(const Command& orb, Context& context);
void add_ports(const Command& orb, Context& context);
void add_run(const Command& orb, Context& context);
void add_spec(const Command& orb, Context& context);
void add_test(const Command& orb, Context& context);
void add_upload(const Command& orb, Context& context);

} // namespace orb::cli
