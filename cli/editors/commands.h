#pragma once

#include "cli/context/context.h"
#include "cli/model/command.h"

namespace orb::cli {

// One function per command, each in the file of the same name. It adds the command to `orb`.
void add_dap(const Command& orb, Context& context);
void add_debug(const Command& orb, Context& context);
void add_lsp(const Command& orb, Context& context);

} // namespace orb::cli
