#include "bytecode/arithmetic.h"
#include "vm/machine/core.h"

// Each block jumps straight to the next one, so that the processor learns which instruction tends
// to follow which. Labels as values are an extension of gcc and clang; WebAssembly has no such
// jump.
#if defined(__GNUC__) && !defined(__wasm__)

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

namespace orb::vm {

namespace {

/// Runs; without a core it only tells where its blocks are.
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

Exit run(Core& core) {
  return run_threaded(&core, nullptr);
}

} // namespace

Engine threaded_engine() {
  const void* const* handlers = nullptr;
  run_threaded(nullptr, &handlers);
  return {handlers, run};
}

} // namespace orb::vm

#pragma GCC diagnostic pop

#endif
