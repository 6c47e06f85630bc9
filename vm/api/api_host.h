#pragma once

#include "base/time.h"
#include "vm/body/body.h"
#include "vm/common/link.h"
#include "vm/common/settings.h"

namespace orb::vm {

class MacroExecutive;
class Power;
class Programs;
class Streamer;

/// The API's view of the ball: everything a client's commands may read or do. Ball implements it
/// and arbitrates against programs and macros (Actor::Client).
class ApiHost {
public:
  virtual ~ApiHost() = default;

  virtual Instant now() const = 0;
  virtual Link& link() = 0;
  virtual Body& body() = 0;
  virtual Streamer& streamer() = 0;
  virtual MacroExecutive& macros() = 0;
  virtual Programs& programs() = 0;
  virtual const Power& power() const = 0;
  virtual const Settings& settings() const = 0;

  /// Applies the settings.
  virtual void change(const Settings& settings) = 0;
  virtual void drive(const Motion& motion) = 0;
  /// Sets the application colour, which programs also read as the colour of cmdrgb.
  virtual void set_led(Color color) = 0;
  virtual void set_back_led(int level) = 0;
  /// Restarts the inactivity timer.
  virtual void stay_awake() = 0;
  /// Puts the ball to sleep as soon as the dispatcher returns.
  virtual void sleep(const Sleep& sleep) = 0;
  /// Stops programs, macros, streams and motors, as a jump to the bootloader does.
  virtual void shut_down() = 0;
  /// Applies the effects of a command. Called once it has been obeyed and answered.
  virtual void command_done() = 0;

  void send(const protocol::Async& async) { link().send(async, now()); }
  template <class Value>
  void set(Value Settings::*setting, Value value) {
    auto changed = settings();
    changed.*setting = value;
    change(changed);
  }
};

} // namespace orb::vm
