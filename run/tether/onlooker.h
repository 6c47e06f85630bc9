#pragma once

#include "protocol/decoder.h"
#include "report/journey.h"
#include "run/tether/wire.h"
#include "vm/ball.h"

#include <memory>
#include <vector>

namespace orb::run {

/// Sees what a classic ball says of itself while a program that runs on it drives it, and tells it
/// to a journey: the way, sensors, prints, errors. Its colour it does not say (API §Get RGB LED is
/// the one that its owner chose).
class Onlooker final : vm::Observer, vm::Elsewhere {
public:
  /// The journey must outlive it.
  explicit Onlooker(report::Journey& journey);

  /// What lets the ball say what it feels, and what silences it; no request moves it.
  std::vector<Request> stream() { return wire_->stream({}); }
  std::vector<Request> silence() const { return wire_->silence(); }

  /// A message that came `t` after the beginning.
  void hear(Duration t, const protocol::Async& message);

private:
  void on_event(Instant at, const vm::Event& event) override;
  void obey(const vm::Motion&) override {} // it drives by itself
  void show(vm::Color) override {}
  void show_back(int) override {}
  void feel(Duration t, const Said& said);

  report::Journey& journey_;
  std::unique_ptr<RobotWire> wire_;
  vm::Ball ball_; ///< one that does what the ball says that it did
};

} // namespace orb::run
