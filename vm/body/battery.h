#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "vm/body/motion.h"

namespace orb::vm {

/// The battery: its voltage at one instant and the drain since. Motion drains it faster.
class Battery {
public:
  explicit Battery(const spec::Battery& range) : range_(range) {}
  /// Takes the charge of one control-system step at `speed_cm_s`.
  void drain(double speed_cm_s);
  void set(double volts, Instant now);
  void set_charger(Switch charger, Instant now);

  double volts(Instant now) const;
  bool charging() const { return charger_ == Switch::On; }
  /// When the voltage falls to `volts_wanted` at rest; `never` while charging or if it is already
  /// lower.
  Instant reaches(double volts_wanted, Instant now) const;
  /// The voltage certainly stays above `volts_wanted` until then, however the ball drives.
  Instant above_until(double volts_wanted, Instant now) const;

private:
  Switch charger_ = Switch::Off;
  Instant at_{};
  spec::Battery range_;
  double volts_ = range_.full;
};

} // namespace orb::vm
