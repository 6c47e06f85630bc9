#include "vm/room/room.h"

#include "spec/ball.h"
#include "vm/body/body.h"
#include "vm/room/contacts.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

namespace orb::vm {
namespace {

constexpr Duration::rep most_steps = 128; ///< longest time that balls advance independently

/// The next time slice: a power of two of steps, at most `longest`, within `left`. If a step has
/// begun, or less than one is left, the rest of it.
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

std::size_t steps_in(Duration time) {
  return static_cast<std::size_t>(time / Body::step);
}

double squared(const Point& one, const Point& other) {
  const double dx = one.x - other.x;
  const double dy = one.y - other.y;
  return dx * dx + dy * dy;
}

} // namespace

Room::Room(const Room& other, std::vector<Resident*> balls) : Room(other) {
  balls_ = std::move(balls);
}

void Room::add(std::string name, Resident& ball) {
  names_.push_back(std::move(name));
  balls_.push_back(&ball);
  outlooks_.push_back(ball.outlook());
  marks_.push_back(0);
}

void Room::advance_to(Duration t) {
  Crowd all(balls_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  while (now_ < t) {
    const auto time = next_while(now_, t - now_, longest_);
    const auto close = pass(all, nullptr, time);
    // Adapt the slice: halve it if most balls are near another, double it if few are.
    const auto steps = std::max<Duration::rep>(time / Body::step, 1);
    if (2 * close > all.size())
      longest_ = std::max<Duration::rep>(steps / 2, 1);
    else if (steps == longest_)
      longest_ = std::min(2 * steps, most_steps);
  }
}

/// The distance within which two balls can touch during `time`.
double Room::reach_cm(const Crowd& crowd, Duration time) const {
  double fastest = 0;
  for (const auto ball : crowd) {
    const auto& outlook = outlooks_[ball];
    const double pushed = outlook.push <= now_ + time ? spec::ball::full_speed : 0;
    fastest = std::max(fastest, outlook.speed_cm_s + pushed);
  }
  fastest += spec::ball::acceleration * seconds(time);
  // Several simultaneous hits may make a ball faster than each of them, but not by this factor.
  constexpr double margin = 1.25;
  constexpr double aside = 1; // cm: how far other balls may shift it meanwhile
  return 2 * (spec::ball::radius + aside + margin * fastest * seconds(time));
}

/// Finds the pairs of a crowd within reach, in order. `known`, if given, contains them all.
void Room::find_pairs(const Crowd& crowd, const Pairs* known, double reach_cm, Pairs& pairs) const {
  constexpr std::size_t cheap = 8; // known pairs per ball: beyond this a new search is faster
  if (known != nullptr && known->size() <= cheap * crowd.size()) {
    pairs.clear();
    std::copy_if(known->begin(), known->end(), std::back_inserter(pairs),
                 [&](const IndexPair& pair) {
                   return squared(outlooks_[pair.first].place, outlooks_[pair.second].place) <=
                          reach_cm * reach_cm;
                 });
    return;
  }
  std::vector<Point> places(crowd.size());
  std::transform(crowd.begin(), crowd.end(), places.begin(),
                 [&](std::size_t ball) { return outlooks_[ball].place; });
  pairs = neighbours(places, reach_cm);
  for (auto& pair : pairs)
    pair = {crowd[pair.first], crowd[pair.second]};
}

/// Advances a crowd that no other ball can reach during `time`. Returns how many of them may have
/// touched another.
std::size_t Room::pass(const Crowd& crowd, const Pairs* known, Duration time) {
  const auto to = now_ + time;
  const bool step = time <= Body::step;
  static_assert(std::bit_width(std::size_t{most_steps}) == std::tuple_size_v<decltype(passes_)>);
  auto& [pairs, close] = passes_[step ? 0 : std::bit_width(steps_in(time)) - 1];
  find_pairs(crowd, known, reach_cm(crowd, time), pairs);
  for (const auto& pair : pairs)
    marks_[pair.first] = marks_[pair.second] = 1;
  close.clear();
  for (const auto ball : crowd) {
    if (std::exchange(marks_[ball], 0) != 0)
      close.push_back(ball);
    else
      move(ball, to);
  }
  if (step)
    for (const auto ball : close)
      move(ball, to);
  else if (!close.empty())
    for (int half = 0; half < 2; ++half)
      pass(close, &pairs, time / 2);
  now_ = to;
  if (step && to % Body::step == Duration{})
    touch(pairs);
  return close.size();
}

void Room::move(std::size_t ball, Duration to) {
  balls_[ball]->advance_to(to);
  outlooks_[ball] = balls_[ball]->outlook();
}

/// Resolves contacts among the pairs that touch.
void Room::touch(const Pairs& pairs) {
  constexpr double touch = 2 * spec::ball::radius;
  Pairs touching;
  std::copy_if(
      pairs.begin(), pairs.end(), std::back_inserter(touching), [&](const IndexPair& pair) {
        return squared(outlooks_[pair.first].place, outlooks_[pair.second].place) <= touch * touch;
      });
  if (!touching.empty())
    meet(std::move(touching));
}

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
    if (shove.change == Point{} && shove.shift == Point{})
      continue;
    balls_[crowd[i]]->meet(shove, names_);
    outlooks_[crowd[i]] = balls_[crowd[i]]->outlook();
  }
}

} // namespace orb::vm
