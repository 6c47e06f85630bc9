#pragma once

#include "base/time.h"
#include "vm/body/ask.h"
#include "vm/body/body.h"
#include "vm/common/settings.h"

#include <optional>
#include <utility>

namespace orb::vm {

/// Arbitrates who may drive: an exclusive holder keeps the others out, otherwise the last command
/// wins. Passes motions to the body, brakes at the motion time-out and remembers clients' rolls.
class Drive {
public:
  Drive(Body& body, const Settings& settings) : body_(&body), settings_(&settings) {}
  /// Copies the state and serves another ball.
  Drive(const Drive& other, Body& body, const Settings& settings) : Drive(other) {
    body_ = &body;
    settings_ = &settings;
  }

  /// Passes a motion to the body. Refuses it if another actor holds the drive or the body ignores
  /// it.
  Outcome obey(Actor actor, const Motion& motion, Instant now);
  /// Returns true if the motion can start or stop the ball.
  static bool may_move(const Motion& motion);
  /// Who currently wants exclusive drive. The first to want it keeps it.
  struct Wanted {
    bool by_program = false;
    bool by_macro = false;
  };
  void share(Wanted wanted);

  /// When the motion time-out expires; `never` without the option flag.
  Instant next_event() const { return deadline_; }
  void run(Instant now);
  /// Applies changed option flags.
  void settings_changed();
  void fall_asleep();

  /// Returns true if a client asked for a roll since the last call. Programs read client_roll().
  bool take_new_roll() { return std::exchange(new_roll_, false); }
  bool new_roll() const { return new_roll_; }
  const Roll& client_roll() const { return client_roll_; }

private:
  Drive(const Drive&) = default;

  bool may(Actor actor) const { return !exclusive_ || *exclusive_ == actor; }

  Body* body_;
  const Settings* settings_;
  std::optional<Actor> exclusive_;
  Instant deadline_ = never;
  bool new_roll_ = false;
  Roll client_roll_;
};

} // namespace orb::vm
