#include "run/room.h"

#include "base/random.h"
#include "run/live.h"
#include "run/start.h"
#include "vm/room/room.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numeric>
#include <utility>

namespace orb::run {
namespace {

/// Forwards the events of one ball. enough() stays false, because the room decides when to end.
class Ear final : public Listener {
public:
  explicit Ear(Listener& listener) : listener_(listener) {}

  void on_start(const vm::Ball& ball) override { listener_.on_start(ball); }
  void on_event(Duration t, const vm::Event& event) override { listener_.on_event(t, event); }
  void on_fault(Duration t, const ProgramError& fault) override { listener_.on_fault(t, fault); }
  void on_end(const Ending& ending) override { listener_.on_end(ending); }

private:
  Listener& listener_;
};

/// A ball of a room while it runs.
class Inhabitant final : public vm::Resident {
public:
  explicit Inhabitant(const RoomBall& ball)
      : ball_(ball), options_(ball.options), ear_(*ball.listener) {
    options_.among = Among::Others;
    options_.until = Until::Rest; // later effects of other balls must be visible
    options_.steps = Steps::Ignored;
  }

  tl::expected<void, Failure> begin() {
    const auto load = load_of(ball_.inputs);
    if (!objection(load) && streams(load))
      return refuse(
          {ExitCode::BadInput, fmt::format("macro `{}` is too long to store and would have "
                                           "to be streamed, which a ball in a room cannot "
                                           "do; make it shorter",
                                           load.macros.front()->name)});
    auto live = Live::start(ball_.inputs, options_, ear_, ball_.journey);
    if (!live)
      return refuse(live.error());
    live_ = std::move(*live);
    return {};
  }

  void advance_to(Duration t) override {
    if (t < next_look_ && live_->coast(t))
      return;
    const bool looks = t >= next_look_;
    const auto halt = looks ? vm::Ball::Halt::Look : vm::Ball::Halt::Pass;
    while (live_->advance(t, halt) && live_->time() < t) {
    }
    if (live_->time() < t)
      live_->wait(t, halt);
    if (looks)
      next_look_ = look_after(t);
  }
  vm::Mover mover() const override { return body().mover(); }
  vm::Outlook outlook() const override {
    return {body().place(), body().most_speed_cm_s(), live_->next_push()};
  }
  void meet(const vm::Shove& shove, std::span<const std::string> names) override {
    live_->meet(shove, names);
  }

  const RoomBall& ball() const { return ball_; }
  const vm::Body& body() const { return live_->ball().body(); }
  /// Returns true if the ball still runs, or still rolls and that matters.
  bool busy() const {
    const bool rolls = ball_.options.until == Until::Rest && body().moving();
    return !live_->ball().quiet() || rolls;
  }
  bool over_early() const { return live_->over_early(); }
  /// Ends the ball even if it still runs.
  void stop() {
    if (busy())
      live_->stop();
  }
  tl::expected<Ending, Failure> finish() {
    auto ending = live_->finish();
    return ending ? ending : refuse(ending.error());
  }

private:
  /// The next end of a slice, or of the run.
  Duration look_after(Duration t) const {
    const auto slice_end = t - t % options_.slice + options_.slice;
    return t < options_.bound ? std::min(slice_end, options_.bound) : slice_end;
  }
  tl::unexpected<Failure> refuse(Failure why) const {
    why.message = fmt::format("{}: {}", ball_.name, why.message);
    return tl::unexpected(std::move(why));
  }

  const RoomBall& ball_;
  Options options_;
  Ear ear_;
  std::unique_ptr<Live> live_;
  Duration next_look_ = look_after({});
};

/// All balls, ordered by name.
using Inhabitants = std::vector<std::unique_ptr<Inhabitant>>;

template <class Holds>
bool any(const Inhabitants& all, Holds holds) {
  return std::any_of(all.begin(), all.end(), [&](const auto& one) { return holds(*one); });
}

/// Advances all balls to `t` and reports steps to the listeners that want them.
void advance(vm::Room& room, const Inhabitants& all, Duration t) {
  const bool steps =
      any(all, [](const Inhabitant& one) { return one.ball().options.steps == Steps::Heard; });
  while (room.now() < t) {
    room.advance_to(steps ? std::min(t, room.now() + vm::Body::step) : t);
    if (steps)
      for (const auto& one : all)
        one->ball().listener->on_step(room.now(), one->body());
  }
  for (const auto& one : all)
    one->ball().listener->on_time(t);
}

void live_on(vm::Room& room, const Inhabitants& all) {
  const auto& options = all.front()->ball().options;
  const auto bound = options.bound == Duration{} ? Duration::max() : options.bound;
  const bool looks = !options.expect.empty() || !options.fail_text.empty();
  constexpr Duration glance = 10ms; // all stop this soon after one has printed the sought text
  const auto piece = looks ? glance : options.slice;
  while (room.now() < bound && any(all, [](const auto& one) { return one.busy(); }) &&
         !any(all, [](const auto& one) { return one.over_early(); }) &&
         any(all, [](const auto& one) { return !one.ball().listener->enough(); }))
    advance(room, all, std::min(bound, room.now() + piece));
  if (any(all, [](const auto& one) { return one.over_early(); }))
    for (const auto& one : all)
      one->stop();
}

/// Distance from a place to the middle of a wall.
double distance_cm(vm::Point place, const vm::Wall& wall) {
  switch (wall.axis) {
  case vm::Wall::Axis::X: return std::abs(place.x - wall.at_cm);
  case vm::Wall::Axis::Y: return std::abs(place.y - wall.at_cm);
  case vm::Wall::Axis::None: break;
  }
  const auto nearest = vm::nearest_point(wall, place);
  return std::hypot(place.x - nearest.x, place.y - nearest.y);
}

/// The walls at the start of the run.
std::vector<vm::Wall> first_walls(const Options& options) {
  std::vector<vm::Wall> walls;
  if (options.course != nullptr)
    walls = options.course->walls;
  for (const auto& event : options.stimuli)
    if (const auto* wall = std::get_if<vm::Wall>(&event.stimulus);
        wall != nullptr && event.at == Duration{})
      walls.push_back(*wall);
  return walls;
}

std::optional<Clash> clash_of(std::span<const RoomBall> balls, std::size_t i) {
  constexpr double least = 1e-9; // cm: rounding errors of balls that touch
  const auto place = balls[i].options.start.place;
  for (std::size_t j = 0; j < i; ++j) {
    const auto other = balls[j].options.start.place;
    if (const double apart = std::hypot(place.x - other.x, place.y - other.y);
        apart < 2 * spec::ball::radius - least)
      return Clash{i, j, std::nullopt, apart};
  }
  for (const auto& wall : first_walls(balls[i].options))
    if (const double apart = distance_cm(place, wall); apart < spec::ball::radius - least)
      return Clash{i, std::nullopt, wall, apart};
  return std::nullopt;
}

} // namespace

std::vector<Clash> clashes(std::span<const RoomBall> balls) {
  std::vector<Clash> found;
  for (std::size_t i = 0; i < balls.size(); ++i)
    if (const auto clash = clash_of(balls, i))
      found.push_back(*clash);
  return found;
}

std::uint64_t seed_of(std::uint64_t run, std::string_view name) {
  for (const char c : name) {
    Random mixed{run + static_cast<unsigned char>(c)};
    run = mixed.next();
  }
  return run;
}

tl::expected<std::vector<Ending>, Failure> run_room(std::span<const RoomBall> balls) {
  Inhabitants all;
  for (const auto& ball : balls)
    all.push_back(std::make_unique<Inhabitant>(ball));
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a->ball().name < b->ball().name; });
  vm::Room room;
  for (const auto& one : all) {
    if (auto begun = one->begin(); !begun)
      return tl::unexpected(begun.error());
    room.add(one->ball().name, *one);
  }
  if (!all.empty())
    live_on(room, all);
  std::vector<Ending> endings(balls.size());
  for (const auto& one : all) {
    auto ending = one->finish();
    if (!ending)
      return tl::unexpected(ending.error());
    endings[static_cast<std::size_t>(&one->ball() - balls.data())] = *std::move(ending);
  }
  return endings;
}

} // namespace orb::run
