#include "vm/room/room.h"

#include "spec/ball.h"
#include "vm/body.h"
#include "vm/room/contacts.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace orb::vm {
namespace {

constexpr Duration::rep most_steps = 128; ///< that balls live by themselves

/// The longest that is halved down to a step, of `longest` steps at most, within `left`; what is
/// left of a step where that is shorter, or where one has begun.
Duration next_while(Duration now, Duration left, Duration::rep longest) {
  if (const auto begun = now % Body::step; begun != Duration{})
    return std::min(left, Body::step - begun);
  Duration time = Body::step;
  if (left < time)
    return left;
  while (2 * time <= std::min(left, longest * Body::step))
    time *= 2;
  return time;
}

double squared(const Point& one, const Point& other) {
  const double dx = one.x - other.x;
  const double dy = one.y - other.y;
  return dx * dx + dy * dy;
}

} // namespace

void Room::add(std::string name, Resident& ball) {
  names_.push_back(std::move(name));
  balls_.push_back(&ball);
  places_.emplace_back();
}

void Room::advance_to(Duration t) {
  Crowd all(balls_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  while (now_ < t) {
    const auto time = next_while(now_, t - now_, longest_);
    const auto close = pass(all, nullptr, time);
    // Where most are near another it was too long, where few are it may be longer.
    const auto steps = std::max<Duration::rep>(time / Body::step, 1);
    if (2 * close > all.size())
      longest_ = std::max<Duration::rep>(steps / 2, 1);
    else if (steps == longest_)
      longest_ = std::min(2 * steps, most_steps);
  }
}

/// The pairs of a crowd that may touch within `time`, in order; all of them are among `known`, if
/// there is that.
Room::Pairs Room::within_reach(const Crowd& crowd, const Pairs* known, Duration time) {
  double fastest = 0;
  for (const auto ball : crowd) {
    places_[ball] = balls_[ball]->mover().place;
    fastest = std::max(fastest, balls_[ball]->most_speed_cm_s(time));
  }
  // Who is hit by several at once may become faster than each of them was, but not by that much.
  constexpr double margin = 1.25;
  constexpr double aside = 1; // cm: how far others may push it out of them in the meantime
  const double reach = 2 * (spec::ball::radius + aside + margin * fastest * seconds(time));
  constexpr std::size_t cheap = 8; // pairs a ball: to look at more takes longer than to search
  Pairs pairs;
  if (known != nullptr && known->size() <= cheap * crowd.size()) {
    std::copy_if(known->begin(), known->end(), std::back_inserter(pairs), [&](const Pair& pair) {
      return squared(places_[pair.first], places_[pair.second]) <= reach * reach;
    });
    return pairs;
  }
  std::vector<Point> places(crowd.size());
  std::transform(crowd.begin(), crowd.end(), places.begin(),
                 [&](std::size_t ball) { return places_[ball]; });
  pairs = neighbours(places, reach);
  for (auto& pair : pairs)
    pair = {crowd[pair.first], crowd[pair.second]};
  return pairs;
}

/// Lets `time` pass for a crowd that no other ball can reach in it; how many of them may have
/// touched another.
std::size_t Room::pass(const Crowd& crowd, const Pairs* known, Duration time) {
  const auto to = now_ + time;
  const auto pairs = within_reach(crowd, known, time);
  std::vector<bool> near(balls_.size());
  for (const auto& pair : pairs)
    near[pair.first] = near[pair.second] = true;
  Crowd close;
  std::copy_if(crowd.begin(), crowd.end(), std::back_inserter(close),
               [&](std::size_t ball) { return near[ball]; });
  if (time <= Body::step) {
    pass_step(crowd, pairs, to);
    return close.size();
  }
  for (const auto ball : crowd)
    if (!near[ball])
      balls_[ball]->advance_to(to);
  if (!close.empty()) {
    pass(close, &pairs, time / 2);
    pass(close, &pairs, time / 2);
  }
  now_ = to;
  return close.size();
}

void Room::pass_step(const Crowd& crowd, const Pairs& pairs, Duration to) {
  for (const auto ball : crowd)
    balls_[ball]->advance_to(to);
  now_ = to;
  if (to % Body::step != Duration{})
    return;
  Pairs touching;
  for (const auto& pair : pairs) {
    constexpr double touch = 2 * spec::ball::radius;
    for (const auto ball : {pair.first, pair.second})
      places_[ball] = balls_[ball]->mover().place;
    if (squared(places_[pair.first], places_[pair.second]) <= touch * touch)
      touching.push_back(pair);
  }
  if (!touching.empty())
    meet(std::move(touching));
}

/// Lets those of the pairs feel each other, which are in touch.
void Room::meet(Pairs pairs) {
  Crowd crowd;
  for (const auto& pair : pairs) {
    crowd.push_back(pair.first);
    crowd.push_back(pair.second);
  }
  std::sort(crowd.begin(), crowd.end());
  crowd.erase(std::unique(crowd.begin(), crowd.end()), crowd.end());
  const auto place_in_crowd = [&](std::size_t ball) {
    return static_cast<std::size_t>(std::lower_bound(crowd.begin(), crowd.end(), ball) -
                                    crowd.begin());
  };
  for (auto& pair : pairs)
    pair = {place_in_crowd(pair.first), place_in_crowd(pair.second)};
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
