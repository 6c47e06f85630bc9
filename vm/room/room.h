#pragma once

#include "base/time.h"
#include "vm/body/shove.h"
#include "vm/room/neighbours.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace orb::vm {

/// What others have to know of a ball to keep clear of it.
struct Outlook {
  Point place;
  double speed_cm_s = 0;           ///< unless it speeds up, or something pushes it
  Duration push = Duration::max(); ///< when something may next
};

/// A ball as a room moves it. Times count from the room's start, which is a step of each ball's
/// control system.
class Resident {
public:
  virtual ~Resident() = default;
  virtual void advance_to(Duration t) = 0;
  virtual Mover mover() const = 0;
  virtual Outlook outlook() const = 0;
  /// Others press on it or have run into it; `names` are those of all balls.
  virtual void meet(const Shove& shove, std::span<const std::string> names) = 0;
};

/// Balls in one world. Each lives by itself for as long as it can touch no other: a while that is
/// halved for those that may, down to a step of the control system, after which contacts are looked
/// for. What happens does not depend on how long that is.
class Room {
public:
  /// The balls, in the order of their names, which are all different; they outlive the room.
  void add(std::string name, Resident& ball);
  /// Lets everything happen up to `t`.
  void advance_to(Duration t);
  Duration now() const { return now_; }

private:
  using Crowd = std::vector<std::size_t>;
  using Pairs = std::vector<Pair>;
  /// What is kept from one while to the next one as long, so that nothing is allocated.
  struct Pass {
    Pairs pairs; ///< that may touch in it
    Crowd close; ///< who is one of a pair
  };
  double reach_cm(const Crowd& crowd, Duration time) const;
  void find_pairs(const Crowd& crowd, const Pairs* known, double reach_cm, Pairs& pairs) const;
  std::size_t pass(const Crowd& crowd, const Pairs* known, Duration time);
  void move(std::size_t ball, Duration to);
  void touch(const Pairs& pairs);
  void meet(Pairs pairs);

  std::vector<std::string> names_;
  std::vector<Resident*> balls_;
  std::vector<Outlook> outlooks_; ///< of each ball, as of when it was moved last
  std::vector<char> marks_;       ///< of each ball; none between calls
  Duration now_{};
  Duration::rep longest_ = 1;  ///< steps that balls live by themselves at most, as it turned out
  std::array<Pass, 8> passes_; ///< of a step, of two, of four …
};

} // namespace orb::vm
