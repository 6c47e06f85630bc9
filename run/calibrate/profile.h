#pragma once

#include "spec/ball.h"
#include "spec/robots.h"

#include <array>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

// Driving parameters measured on one robot: `orb calibrate -o NAME`, `orb run --ball NAME`.

namespace orb::run {

inline constexpr double dead_step_ms = 1000.0 / spec::ball::control_rate;

/// A parameter of spec::Driving that a drive can determine.
struct DrivingRow {
  std::string_view name; ///< of the row in spec/ball.def
  std::string_view unit; ///< may be empty
  double least = 0;
  double most = 0;
  double spec::Driving::*place = nullptr; ///< null: dead_time, which counts steps
};

inline constexpr auto driving_rows = std::to_array<DrivingRow>({
    {"speed_offset", "cm/s", -100, 500, &spec::Driving::speed_offset},
    {"speed_slope", "cm/s", 0.01, 20, &spec::Driving::speed_slope},
    {"speed_lag", "s", 0.01, 5, &spec::Driving::speed_lag},
    {"dead_time", "ms", 0, spec::most_dead_steps* dead_step_ms, nullptr},
    {"grip", "cm/s2", 5, 5000, &spec::Driving::grip},
    {"turn_gain", "", 0.1, 20, &spec::Driving::turn_gain},
});
/// A parameter that no drive in a room can determine: kept unchanged and still written.
inline constexpr DrivingRow full_speed_row{"full_speed", "cm/s", 1, 2000,
                                           &spec::Driving::full_speed};

/// In the unit of the row.
double value_of(const spec::Driving& numbers, const DrivingRow& row);
void set_value(spec::Driving& numbers, const DrivingRow& row, double value);

struct Profile {
  spec::Robot robot = spec::Robot::Sphero;
  spec::Driving driving;
  int slowest = spec::ball::slowest_driven; ///< the lowest ordered speed measured
  int fastest = spec::ball::fastest_driven; ///< the highest
};

/// Writes TOML, one number per line with its unit. Reading it back is exact to four digits.
std::string to_text(const Profile& profile);

/// The error names the line and what to write. A missing row means the robot's own value.
tl::expected<Profile, std::string> parse_profile(std::string_view text);

} // namespace orb::run
