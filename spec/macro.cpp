#include "spec/macro.h"

namespace orb::spec {

std::string_view to_string(MacroUnit unit) {
  switch (unit) {
  case MacroUnit::None: return "";
  case MacroUnit::Milliseconds: return "ms";
  case MacroUnit::Ticks10ms: return "10 ms";
  case MacroUnit::Degrees: return "deg";
  }
  return "";
}

} // namespace orb::spec
