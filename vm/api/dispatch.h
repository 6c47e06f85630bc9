#pragma once

// Private to vm/api/dispatch_*.cpp: declares the command handlers.

#include "vm/api/dispatcher.h"
#include "vm/api/streamer.h"
#include "vm/common/power.h"
#include "vm/machine/programs.h"
#include "vm/macros/macro_executive.h"

/// Opens the handler of a command: `HANDLE(Ping) { … }`. The body may use `call`.
#define HANDLE(command)                                                                            \
  template <>                                                                                      \
  Dispatcher::Reply Dispatcher::handle<spec::ApiCommand::command>([[maybe_unused]] Call call)

namespace orb::vm {

#define COMMAND(enumerator, ...) HANDLE(enumerator);
#include "spec/api.def"

} // namespace orb::vm
