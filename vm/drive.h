#pragma once

#include "base/time.h"
#include "vm/body/ask.h"
#include "vm/body/body.h"
#include "vm/settings.h"

#include <optional>
#include <utility>

namespace orb::vm {

/// Who may drive: an exclusive holder keeps the others out, else the last command wins. It hands
/// what is asked to the body, brakes when the motion time-out is over, and remembers what clients
/// asked.
class Drive {
public:
  Drive(Body& body, const Settings& settings) : body_(&body), settings_(&settings) {}
  /// A copy that serves another ball.
  Drive(const Drive& other, Body& body, const Settings& settings) : Drive(other) {
    body_ = &body;
    settings_ = &settings;
  }

  /// Does what is asked, unless it is excluded or the body ignores it.
  Outcome obey(Actor actor, const Motion& motion, Instant now);
  /// Whether the ball may begin or cease to move by it.
  static bool may_move(const Motion& motion);
  /// Who wants to drive alone at present; of two the first to want it holds it.
  struct Wanted {
    bool by_program = false;
    bool by_macro = false;
  };
  void share(Wanted wanted);

  /// When the last motion command has had its time; `never` without the option flag.
  Instant next_event() const { return deadline_; }
  void run(Instant now);
  /// The options have changed.
  void settings_changed();
  void fall_asleep();

  /// Whether a client has asked for a roll since the last call, and which, for programs.
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
