#pragma once

#include "base/exit_code.h"
#include "run/calibrate/measuring_drive.h"
#include "run/calibrate/profile.h"

#include <array>
#include <span>
#include <string>
#include <tl/expected.hpp>

namespace orb::run {

/// The result of a measuring drive.
struct Calibration {
  spec::Driving before; ///< the model's
  spec::Driving after;
  std::array<double, driving_rows.size()> spread{}; ///< one sigma of each parameter, in its unit
  std::array<bool, driving_rows.size()> open{};     ///< undetermined: `after` has the model's value
  double error_before_cm = 0;                       ///< root mean square error of the places
  double error_after_cm = 0;
  std::size_t used = 0; ///< number of legs; the others were broken or do not fit
  std::size_t legs = 0;
  int slowest = 0;   ///< the lowest ordered speed of the legs used
  int fastest = 0;   ///< the highest
  std::string doubt; ///< why the parameters are not trustworthy, and what to do; or empty
};

/// Fits the model to the legs: least squares of places and yaws (Levenberg and Marquardt). The
/// distance from `robot`'s own parameters does not matter. Fails if no leg is usable.
tl::expected<Calibration, Failure> fit(std::span<const Leg> legs, spec::Robot robot);

/// Returns the parameters of `robot` with the speeds fitted to the legs. Needs few legs; what they
/// leave open stays near `robot`'s own.
spec::Driving with_speeds_of(std::span<const Leg> legs, spec::Robot robot);

} // namespace orb::run
