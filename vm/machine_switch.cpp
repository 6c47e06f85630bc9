#include "vm/machine_calculate.h"
#include "vm/machine_core.h"

namespace orb::vm {

namespace {

Exit run(Core& core) {
#define ORB_SWITCH
#define OP(name) case Op::name:
#define DISPATCH() goto dispatch
#include "vm/machine_loop.h"
}

} // namespace

// The handler of an operation is its number.
Engine switch_engine() {
  static const auto handlers = [] {
    std::array<const void*, bytecode::ops.size()> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = reinterpret_cast<const void*>(i);
    return made;
  }();
  return {handlers.data(), run};
}

} // namespace orb::vm
