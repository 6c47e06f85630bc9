#pragma once

#include "base/exit_code.h"
#include "base/time.h"
#include "spec/robots.h"
#include "vm/body/remote_body.h"
#include "vm/common/observer.h"
#include "vm/stimulus.h"

#include <tl/expected.hpp>
#include <variant>
#include <vector>

namespace orb::run {

/// News from a robot that matters to a run.
using Felt = std::variant<vm::Sample, vm::event::Collision, vm::stimulus::Battery>;

/// A robot driven by a run that can be held, for example at a breakpoint: it then brakes and stays
/// silent while the run's time stands still. Initially held. The destructor sends a stop.
class HeldRobot : public vm::RemoteBody {
public:
  /// The kind of robot, which determines its battery.
  virtual spec::Robot kind() const { return spec::Robot::Sphero; }
  /// Its sample before the run.
  virtual const vm::Sample& first() const = 0;
  /// Releases it: it drives on as before hold(). The run's time is now `t`.
  virtual tl::expected<void, Failure> go_on(Duration t) = 0;
  /// The run's time, while it is not held.
  virtual Duration time() const = 0;
  /// Sends what is due and waits for news until the run reaches `until`, or for a short while.
  virtual tl::expected<std::vector<Felt>, Failure> hear(Duration until) = 0;
  /// Brakes it. Fails if it does not acknowledge that.
  virtual tl::expected<void, Failure> hold() = 0;
};

} // namespace orb::run
