#pragma once

#include "base/time.h"
#include "vm/body/shove.h"
#include "vm/room/neighbours.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace orb::vm {

/// A ball as a room moves it. Times count from the room's start, which is a step of each ball's
/// control system.
class Resident {
public:
  virtual ~Resident() = default;
  virtual void advance_to(Duration t) = 0;
  virtual Mover mover() const = 0;
  /// So fast it can be within `time` from now unless another ball runs into it, cm/s.
  virtual double most_speed_cm_s(Duration time) const = 0;
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
  Pairs within_reach(const Crowd& crowd, const Pairs* known, Duration time);
  std::size_t pass(const Crowd& crowd, const Pairs* known, Duration time);
  void pass_step(const Crowd& crowd, const Pairs& pairs, Duration to);
  void meet(Pairs pairs);

  std::vector<std::string> names_;
  std::vector<Resident*> balls_;
  Duration now_{};
  Duration::rep longest_ = 1; ///< steps that balls live by themselves at most, as it turned out
  std::vector<Point> places_; ///< of each ball, where it was looked at last
};

} // namespace orb::vm
