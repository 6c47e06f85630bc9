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

/// What others must know to keep clear of a ball.
struct Outlook {
  Point place;
  double speed_cm_s = 0;           ///< unless it accelerates or is pushed
  Duration push = Duration::max(); ///< when it may next be pushed
};

/// A ball as a room moves it. Times count from the room's start, which coincides with a step of
/// each ball's control system.
class Resident {
public:
  virtual ~Resident() = default;
  virtual void advance_to(Duration t) = 0;
  virtual Mover mover() const = 0;
  virtual Outlook outlook() const = 0;
  /// Applies contact with other balls. `names` are the names of all balls.
  virtual void meet(const Shove& shove, std::span<const std::string> names) = 0;
};

/// Balls in one world. Each advances independently while it cannot touch another; for those that
/// may, the time is halved, down to one step of the control system, after which contacts are
/// resolved. Results do not depend on these times.
class Room {
public:
  Room() = default;
  /// Copies a room for copies of its balls, in the order of those of `other`.
  Room(const Room& other, std::vector<Resident*> balls);
  /// Adds a ball. Names must be unique and in order; the ball must outlive the room.
  void add(std::string name, Resident& ball);
  /// Runs everything that is due up to `t`.
  void advance_to(Duration t);
  Duration now() const { return now_; }

private:
  using Crowd = std::vector<std::size_t>;
  using Pairs = std::vector<IndexPair>;
  /// Buffers kept for slices of one length, so that nothing is allocated.
  struct Pass {
    Pairs pairs; ///< pairs that may touch
    Crowd close; ///< balls that are in a pair
  };
  double reach_cm(const Crowd& crowd, Duration time) const;
  void find_pairs(const Crowd& crowd, const Pairs* known, double reach_cm, Pairs& pairs) const;
  std::size_t pass(const Crowd& crowd, const Pairs* known, Duration time);
  void move(std::size_t ball, Duration to);
  void touch(const Pairs& pairs);
  void meet(Pairs pairs);

  std::vector<std::string> names_;
  std::vector<Resident*> balls_;
  std::vector<Outlook> outlooks_; ///< by ball, as of its last move
  std::vector<char> marks_;       ///< by ball; all 0 between calls
  Duration now_{};
  Duration::rep longest_ = 1;  ///< longest slice in steps, adapted while running
  std::array<Pass, 8> passes_; ///< for slices of one step, two, four …
};

} // namespace orb::vm
