#include "vm/macro_executive.h"

namespace orb::vm {

void MacroExecutive::run(Instant, MacroHost&) {}
bool MacroExecutive::start(int, Instant, MacroHost&) {
  return false;
}
bool MacroExecutive::abort(Instant, MacroHost&) {
  return true;
}
void MacroExecutive::collision(Instant, MacroHost&) {}
void MacroExecutive::forget_user_macros() {}

} // namespace orb::vm
