#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "vm/body/motion.h"

namespace orb::vm {

/// A voltage at an instant and its slope since; motion takes more.
class Battery {
public:
  explicit Battery(const spec::Battery& range) : range_(range) {}
  /// What a step of the control system at `speed_cm_s` takes.
  void drain(double speed_cm_s);
  void set(double volts, Instant now);
  void set_charger(Switch charger, Instant now);

  double volts(Instant now) const;
  bool charging() const { return charger_ == Switch::On; }
  /// When the voltage falls to `volts_wanted` at rest; `never` while charging or below already.
  Instant reaches(double volts_wanted, Instant now) const;
  /// Until when it is above that for sure, however the ball drives.
  Instant above_until(double volts_wanted, Instant now) const;

private:
  Switch charger_ = Switch::Off;
  Instant at_{};
  spec::Battery range_;
  double volts_ = range_.full;
};

} // namespace orb::vm
