#pragma once

#include "base/time.h"
#include "vm/body/body.h"
#include "vm/link.h"
#include "vm/settings.h"

namespace orb::vm {

class MacroExecutive;
class Power;
class Programs;
class Streamer;

/// All that the API can do to the ball and ask of it, for the client that is connected. Ball
/// implements it and arbitrates against programs and macros (Actor::Client).
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

  /// Puts these settings into effect.
  virtual void change(const Settings& settings) = 0;
  virtual void drive(const Motion& motion) = 0;
  /// The application colour; it is also what cmdrgb tells programs.
  virtual void set_led(Color color) = 0;
  virtual void set_back_led(int level) = 0;
  /// The inactivity timer starts again.
  virtual void stay_awake() = 0;
  /// Falls asleep as soon as the dispatcher has returned.
  virtual void sleep(const Sleep& sleep) = 0;
  /// Stops programs, macros, streams and motors, as for the bootloader.
  virtual void shut_down() = 0;
  /// A command has been obeyed and answered: what it led to takes effect.
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
