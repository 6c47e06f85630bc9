#include "bytecode/arithmetic.h"
#include "vm/machine/core.h"

// Jumps directly from block to block, so that the processor can predict each instruction from the
// one before. Uses labels as values, an extension of gcc and clang; WebAssembly has no computed
// jumps.
#if defined(__GNUC__) && !defined(__wasm__)

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

namespace orb::vm {

namespace {

/// Runs the core. Without a core it only returns the table of handlers.
Exit run_threaded(Core* machine, const void* const** table) {
  static const void* const handlers[] = {
#define ORB_Value(name) &&name, &&name
#define ORB_Either(name) &&name, &&name##Line
#define ORB_Line(name) &&name, &&name
#define ORB_OP(name, ends, ...) ORB_##ends(name),
#include "bytecode/op.def"
  };
  if (!machine) {
    *table = handlers;
    return Exit::Ended;
  }
  Core& core = *machine;
#define OP(name)                                                                                   \
  name:
#define OP_LINE(name) name##Line:
#define DISPATCH() goto * pc->handler
#include "vm/machine/loop.h"
}

Exit run_directly(Core& core) {
  return run_threaded(&core, nullptr);
}

} // namespace

Engine threaded_engine() {
  const void* const* handlers = nullptr;
  run_threaded(nullptr, &handlers);
  return {handlers, run_directly};
}

} // namespace orb::vm

#pragma GCC diagnostic pop

#endif
