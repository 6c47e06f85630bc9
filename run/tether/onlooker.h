#pragma once

#include "protocol/decoder.h"
#include "report/journey.h"
#include "run/tether/wire.h"
#include "vm/ball.h"

#include <memory>
#include <vector>

namespace orb::run {

/// Records in a journey what a classic ball reports while it runs its own program: path, sensors,
/// prints, errors. The colour is missing, because the ball does not report it (API §Get RGB LED
/// returns the one that its owner chose).
class Onlooker final : vm::Observer, vm::RemoteBody {
public:
  /// The journey must outlive it.
  explicit Onlooker(report::Journey& journey);

  /// Requests that make the ball report its sensors, and that silence it. None of them moves it.
  std::vector<Request> stream() { return wire_->stream({}); }
  std::vector<Request> silence() const { return wire_->silence(); }

  /// Takes a message that arrived `t` after the beginning.
  void hear(Duration t, const protocol::Async& message);

private:
  void on_event(Instant at, const vm::Event& event) override;
  void obey(const vm::Motion&) override {} // the ball drives itself
  void show(vm::Color) override {}
  void show_back(int) override {}
  void feel(Duration t, const RobotMessage& said);

  report::Journey& journey_;
  std::unique_ptr<RobotWire> wire_;
  vm::Ball ball_; ///< mirrors what the real ball reports
};

} // namespace orb::run
