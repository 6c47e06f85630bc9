#pragma once

#include "base/exit_code.h"
#include "run/calibrate/course.h"
#include "run/calibrate/profile.h"

#include <array>
#include <span>
#include <tl/expected.hpp>

namespace orb::run {

/// What a drive tells of a robot.
struct Calibration {
  spec::Driving before; ///< the model's
  spec::Driving after;
  std::array<double, driving_rows.size()> spread{}; ///< of each number, in its unit: one sigma
  double error_before_cm = 0;                       ///< what the places differ by, root mean square
  double error_after_cm = 0;
  std::size_t used = 0; ///< how many legs; the others were broken or do not fit
  std::size_t legs = 0;
};

/// The numbers by which the model drives the legs most like the robot did: least squares of places
/// and yaws (Levenberg and Marquardt), from those of `robot`. Fails where too few legs are of use,
/// where the drive leaves a number open or puts it further from the model's than the method was
/// tried for, and where no numbers tell where the robot went.
tl::expected<Calibration, Failure> fit(std::span<const Leg> legs, spec::Robot robot);

} // namespace orb::run
