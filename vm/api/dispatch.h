#pragma once

// For vm/dispatch_*.cpp only: the handlers of the commands.

#include "vm/api/dispatcher.h"
#include "vm/api/streamer.h"
#include "vm/macros/macro_executive.h"
#include "vm/power.h"
#include "vm/programs.h"

/// Opens the handler of a command: `HANDLE(Ping) { … }`. It sees `call`.
#define HANDLE(command)                                                                            \
  template <>                                                                                      \
  Dispatcher::Reply Dispatcher::handle<spec::ApiCommand::command>([[maybe_unused]] Call call)

namespace orb::vm {

#define COMMAND(enumerator, ...) HANDLE(enumerator);
#include "spec/api.def"

} // namespace orb::vm
