#pragma once

#include "base/time.h"
#include "vm/body/ask.h"
#include "vm/body/body.h"

#include <optional>
#include <utility>

namespace orb::vm {

/// Decides whose colour shows. Priority: the battery warning, the macro, the program, the
/// application, the user. Without a client the identification colours blink. Source: API §Set RGB
/// LED Output and the macro and orbBasic flags.
class Lamps {
public:
  /// Inputs to the decision, besides the colours themselves.
  struct Situation {
    Instant now;
    bool asleep = false;
    bool battery_warns = false;
    bool connected = false;
    bool program_first = false;  ///< BF_KEEP_LED: the program has priority over the macro
    bool tail_always_on = false; ///< permanent option flag
    Color user_color;
  };

  void set(Actor actor, Color color);
  void set_back(int level) { back_level_ = level; }
  /// Drops the colour of an actor that has finished or disconnected.
  void release(Actor actor) { color_of(actor).reset(); }

  void fall_asleep();
  /// Mirrors the lamps to a remote robot, which must outlive this object.
  void become(RemoteBody& robot);

  /// Updates the colour, or the level of the back LED. Returns it if it changed.
  std::optional<Color> show(const Situation& situation);
  std::optional<int> show_back(const Situation& situation);
  Color shown() const { return shown_; }
  /// When the identification colours blink next; `never` if they do not.
  Instant next_blink(const Situation& situation) const;

  /// Returns true if a client set a colour since the last call. Programs read client_color().
  bool take_new_color() { return std::exchange(new_color_, false); }
  bool new_color() const { return new_color_; }
  Color client_color() const { return client_color_; }

private:
  std::optional<Color>& color_of(Actor actor) { return set_[static_cast<std::size_t>(actor)]; }
  const std::optional<Color>& color_of(Actor actor) const {
    return set_[static_cast<std::size_t>(actor)];
  }
  Color deciding(const Situation& situation) const;

  std::optional<Color> set_[actors];
  Color client_color_;
  bool new_color_ = false;
  int back_level_ = 0;
  Color shown_;
  int shown_back_ = 0;
  RemoteBody* robot_ = nullptr;
};

} // namespace orb::vm
