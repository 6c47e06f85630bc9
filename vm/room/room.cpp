#include "vm/room/room.h"

#include "vm/body.h"
#include "vm/room/contacts.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace orb::vm {
namespace {

constexpr Duration::rep longest = 128; ///< steps that balls live by themselves at most

/// The longest that is halved down to a step, within `left`; what is left of a step where that is
/// shorter, or where one has begun.
Duration next_while(Duration now, Duration left) {
  if (const auto begun = now % Body::step; begun != Duration{})
    return std::min(left, Body::step - begun);
  Duration time = Body::step;
  if (left < time)
    return left;
  while (2 * time <= std::min(left, longest * Body::step))
    time *= 2;
  return time;
}

} // namespace

void Room::add(std::string name, Resident& ball) {
  names_.push_back(std::move(name));
  balls_.push_back(&ball);
}

void Room::advance_to(Duration t) {
  Crowd all(balls_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  while (now_ < t)
    pass(all, next_while(now_, t - now_));
}

/// The pairs of a crowd, by their places in it, that may touch within `time`.
std::vector<Pair> Room::within_reach(const Crowd& crowd, Duration time) const {
  std::vector<Point> places;
  double fastest = 0;
  for (const auto ball : crowd) {
    places.push_back(balls_[ball]->mover().place);
    fastest = std::max(fastest, balls_[ball]->most_speed_cm_s(time));
  }
  // Who is hit by several at once may become faster than each of them was, but not by that much.
  constexpr double margin = 1.25;
  constexpr double aside = 1; // cm: how far others may push it out of them in the meantime
  return neighbours(places, 2 * (spec::ball::radius + aside + margin * fastest * seconds(time)));
}

void Room::pass(const Crowd& crowd, Duration time) {
  const auto to = now_ + time;
  const auto pairs = within_reach(crowd, time);
  if (time <= Body::step)
    return pass_step(crowd, pairs, to);
  std::vector<bool> near(crowd.size());
  for (const auto& pair : pairs)
    near[pair.first] = near[pair.second] = true;
  Crowd close;
  for (std::size_t i = 0; i < crowd.size(); ++i)
    if (near[i])
      close.push_back(crowd[i]);
    else
      balls_[crowd[i]]->advance_to(to);
  if (!close.empty()) {
    pass(close, time / 2);
    pass(close, time / 2);
  }
  now_ = to;
}

void Room::pass_step(const Crowd& crowd, std::span<const Pair> pairs, Duration to) {
  for (const auto ball : crowd)
    balls_[ball]->advance_to(to);
  now_ = to;
  if (pairs.empty() || to % Body::step != Duration{})
    return;
  std::vector<Mover> movers;
  for (const auto ball : crowd)
    movers.push_back(balls_[ball]->mover());
  auto shoves = contacts(movers, pairs);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    auto& shove = shoves[i];
    for (auto& knock : shove.knocks)
      knock.other = crowd[knock.other];
    if (shove.change != Point{} || shove.shift != Point{})
      balls_[crowd[i]]->meet(shove, names_);
  }
}

} // namespace orb::vm
