#pragma once

#include "base/exit_code.h"
#include "run/calibrate/course.h"
#include "run/calibrate/profile.h"

#include <array>
#include <span>
#include <string>
#include <tl/expected.hpp>

namespace orb::run {

/// What a drive tells of a robot.
struct Calibration {
  spec::Driving before; ///< the model's
  spec::Driving after;
  std::array<double, driving_rows.size()> spread{}; ///< of each number, in its unit: one sigma
  std::array<bool, driving_rows.size()> open{};     ///< not determined: `after` has the model's
  double error_before_cm = 0;                       ///< what the places differ by, root mean square
  double error_after_cm = 0;
  std::size_t used = 0; ///< how many legs; the others were broken or do not fit
  std::size_t legs = 0;
  int slowest = 0; ///< the ordered speeds of the legs used: from here,
  int fastest = 0; ///< to here
  std::string
      doubt; ///< why these numbers do not tell how the robot drives, and what to do; or empty
};

/// The numbers by which the model drives the legs most like the robot did: least squares of places
/// and yaws (Levenberg and Marquardt). How far they are from those of `robot` does not count.
/// Fails where no leg is of use.
tl::expected<Calibration, Failure> fit(std::span<const Leg> legs, spec::Robot robot);

/// The numbers of `robot`, but for the speeds: those at which the legs were driven. Few legs do;
/// where they leave the line of speeds open, it is near that of `robot`.
spec::Driving with_speeds_of(std::span<const Leg> legs, spec::Robot robot);

} // namespace orb::run
