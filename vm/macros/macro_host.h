#pragma once

#include "base/time.h"
#include "vm/common/settings.h"

#include <cstdint>

namespace orb::vm {

/// The macro executive's view of the ball: everything a macro may read or do. Ball implements it,
/// arbitrates against clients and programs (Actor::Macro) and traces; the executive keeps time and
/// order.
class MacroHost {
public:
  virtual ~MacroHost() = default;

  virtual void drive(const Motion& motion) = 0;
  virtual void set_led(Color color) = 0;
  virtual void set_back_led(int level) = 0;
  virtual void configure_collisions(const CollisionSettings& settings) = 0;
  /// Sends the marker message (async 06h). `command` counts from 1.
  virtual void emit_marker(int marker, int macro, int command) = 0;
  /// Reports to the observer which command begins.
  virtual void trace_command(int macro, int command) = 0;
  /// Puts the ball to sleep when the executive returns, for `time_ms`: 0 forever,
  /// spec::macro_sleep_inherit as long as the last sleep.
  virtual void sleep_ms(int time_ms) = 0;

  /// Returns true if the next command may begin; otherwise the executive returns before it.
  virtual bool may_begin() { return true; }

  virtual bool stopped() const = 0;
  virtual bool connected() const = 0;
};

} // namespace orb::vm
