#include "run/tether/driven.h"

#include <algorithm>
#include <utility>

namespace orb::run {
namespace {

/// Limits how far the program may lag behind the link, and thereby its reaction time.
constexpr Duration shortest_nap = 2ms;

} // namespace

void bring(Live& live, Duration t) {
  live.advance(t);
  live.wait(t);
}

void feel(Live& live, const RobotMessage& said) {
  if (const auto* sample = std::get_if<vm::Sample>(&said.what))
    live.feel(*sample);
  else if (const auto* collision = std::get_if<vm::event::Collision>(&said.what))
    live.feel(*collision);
  else if (const auto* battery = std::get_if<vm::stimulus::Battery>(&said.what))
    live.apply(*battery);
}

std::function<void(const RobotMessage&)> Driven::hear() {
  return [this](const RobotMessage& said) {
    if (!over_) // the program's time has ended
      bring(live_, elapsed());
    if (const auto* sample = std::get_if<vm::Sample>(&said.what))
      note(*sample);
    else if (const auto* collision = std::get_if<vm::event::Collision>(&said.what))
      note(*collision);
    else if (const auto* battery = std::get_if<vm::stimulus::Battery>(&said.what))
      note(*battery);
    feel(live_, said);
  };
}

Duration Driven::nap() const {
  return std::clamp(live_.next_event() - elapsed(), shortest_nap, longest_nap);
}

tl::expected<Driven::Progress, Failure> Driven::step() {
  if (robot_.is_stale() || paused_at_) {
    if (auto back = sit_out(); !back)
      return tl::unexpected(back.error());
    return Progress::GoesOn;
  }
  if (!live_.advance(elapsed())) {
    if (!live_.waits_for_number() || !listener_.has_more_numbers())
      return Progress::Ends;
    if (const auto number = listener_.ask_number())
      live_.give(*number);
    live_.wait(elapsed());
  }
  if (auto pumped = robot_.pump(robot_.now() + nap(), hear()); !pumped)
    return tl::unexpected(pumped.error());
  return Progress::GoesOn;
}

void Driven::end() {
  over_ = true;
  note(DriveLine::Over{});
}

void Driven::note(decltype(DriveLine::what) what) {
  if (options_.recording != nullptr)
    options_.recording->lines.push_back({live_.time(), std::move(what)});
}

/// Waits for samples while the program's time stands still.
tl::expected<void, Failure> Driven::sit_out() {
  if (!paused_at_) {
    paused_at_ = elapsed();
    if (options_.note)
      options_.note(std::string(samples_gone));
  }
  if (auto pumped = robot_.pump(robot_.now() + longest_nap,
                                [](const RobotMessage&) {}); // news received meanwhile is dropped
      !pumped)
    return pumped;
  if (robot_.is_stale())
    return {};
  origin_ = robot_.program_now() - *std::exchange(paused_at_, std::nullopt);
  if (options_.note)
    options_.note(std::string(samples_back));
  return {};
}

} // namespace orb::run
