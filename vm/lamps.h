#pragma once

#include "base/time.h"
#include "vm/body/ask.h"
#include "vm/body/body.h"

#include <optional>
#include <utility>

namespace orb::vm {

/// Whose colour shows: the battery's warning before a macro's colour, before the program's, before
/// the application's, before the user's; without a client the identification colours blink.
/// Source: API §Set RGB LED Output and the macro and orbBasic flags.
class Lamps {
public:
  /// What decides besides the colours that were set.
  struct Situation {
    Instant now;
    bool asleep = false;
    bool battery_warns = false;
    bool connected = false;
    bool program_first = false;  ///< BF_KEEP_LED: the program's colour before the macro's
    bool tail_always_on = false; ///< permanent option flag
    Color user_color;
  };

  void set(Actor actor, Color color);
  void set_back(int level) { back_level_ = level; }
  /// The colour of whoever is done, or gone, shows no more.
  void release(Actor actor) { color_of(actor).reset(); }

  void fall_asleep();
  /// From now on the lamps of a robot show the same; it must outlive these.
  void become(Elsewhere& robot);

  /// The colour, or the level of the back LED, that shows from now on, where that is news.
  std::optional<Color> show(const Situation& situation);
  std::optional<int> show_back(const Situation& situation);
  Color shown() const { return shown_; }
  /// When the identification colours blink next; `never` while they do not.
  Instant next_blink(const Situation& situation) const;

  /// Whether a client has set a colour since the last call, and which, for programs.
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
  Elsewhere* robot_ = nullptr;
};

} // namespace orb::vm
