#include "bytecode/arithmetic.h"
#include "vm/machine/core.h"

namespace orb::vm {

namespace {

using bytecode::Op;

Exit run(Core& core) {
#define ORB_SWITCH
#define OP(name) case 2 * static_cast<std::uintptr_t>(Op::name):
#define OP_LINE(name) case 2 * static_cast<std::uintptr_t>(Op::name) + 1:
#define DISPATCH() goto dispatch
#include "vm/machine/loop.h"
}

} // namespace

// The handler of an operation is its case number.
Engine switch_engine() {
  static const auto handlers = [] {
    std::array<const void*, 2 * bytecode::ops.size()> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = reinterpret_cast<const void*>(i);
    return made;
  }();
  return {handlers.data(), run};
}

#if !defined(__GNUC__) || defined(__wasm__) // see threaded.cpp
Engine threaded_engine() {
  return switch_engine();
}
#endif

} // namespace orb::vm
