#pragma once

#include "base/time.h"
#include "vm/macro_host.h"

#include <cstdint>

namespace orb::vm {

/// Runs macros: decides what happens when, and asks MacroHost to do it. Ball calls it like this:
///   - `next_event()` is when the executive wants to run next (`never` while idle);
///   - `run(now, host)` then does all that is due at `now`, at most 64 commands a millisecond;
///   - `start`, `abort`, `collision`, `forget_user_macros` come from orbBasic, sleep and
///   collisions.
/// What only clients ask (save, append, modal parameters…) the dispatcher asks through
/// `Ball::macros()`, followed by `Ball::macros_changed()`.
class MacroExecutive {
public:
  Instant next_event() const { return never; }
  void run(Instant now, MacroHost& host);

  bool running() const { return false; }
  /// The id of the running macro; 0 when none runs.
  int id() const { return 0; }
  /// The flags byte of the running macro; 0 when none runs.
  std::uint8_t flags() const { return 0; }
  /// `id << 16 | command number` of the running macro; 0 when none runs (orbBasic `macstat`).
  std::uint32_t status() const { return 0; }

  /// Starts a stored macro at `now`. False when there is none of that id, or it may not run now.
  bool start(int id, Instant now, MacroHost& host);
  /// Stops the running macro unless it is unkillable. True when none runs afterwards.
  bool abort(Instant now, MacroHost& host);
  /// A collision was reported (Branch On Collision).
  void collision(Instant now, MacroHost& host);
  /// The user macros' index is lost in sleep.
  void forget_user_macros();
};

} // namespace orb::vm
