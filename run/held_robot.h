#pragma once

#include "base/exit_code.h"
#include "base/time.h"
#include "spec/robots.h"
#include "vm/body/elsewhere.h"
#include "vm/observer.h"
#include "vm/stimulus.h"

#include <tl/expected.hpp>
#include <variant>
#include <vector>

namespace orb::run {

/// What a robot says that a run is to know.
using Felt = std::variant<vm::Sample, vm::event::Collision, vm::stimulus::Battery>;

/// A robot that drives as a run says, and that somebody may hold, as a debugger does at a
/// breakpoint: then it is braked and says nothing, and the time of the run stands still. It is held
/// to begin with. When it is destroyed, it has been told to stop.
class HeldRobot : public vm::Elsewhere {
public:
  /// Which it is: its battery is its own.
  virtual spec::Robot kind() const { return spec::Robot::Sphero; }
  /// What it said before the run.
  virtual const vm::Sample& first() const = 0;
  /// Lets it drive on as it did when it was held; the time of the run is `t` now.
  virtual tl::expected<void, Failure> go_on(Duration t) = 0;
  /// The time of the run that has passed, while it is not held.
  virtual Duration time() const = 0;
  /// Sends what is due and waits for news until the run has come to `until`, or a little while.
  virtual tl::expected<std::vector<Felt>, Failure> hear(Duration until) = 0;
  /// Brakes it. Fails where it has not acknowledged that.
  virtual tl::expected<void, Failure> hold() = 0;
};

} // namespace orb::run
