#pragma once

#include "spec/ball.h"
#include "spec/robots.h"

#include <array>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

// How one robot drives, measured on it: `orb calibrate -o NAME`, `orb run --ball NAME`.

namespace orb::run {

inline constexpr double dead_step_ms = 1000.0 / spec::ball::control_rate;

/// A number of spec::Driving that a drive can tell.
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
/// A number that no drive in a room tells: kept as it is, and told nevertheless.
inline constexpr DrivingRow full_speed_row{"full_speed", "cm/s", 1, 2000,
                                           &spec::Driving::full_speed};

/// In the unit of the row.
double value_of(const spec::Driving& numbers, const DrivingRow& row);
void set_value(spec::Driving& numbers, const DrivingRow& row, double value);

struct Profile {
  spec::Robot robot = spec::Robot::Sphero;
  spec::Driving driving;
  int slowest = spec::ball::slowest_driven; ///< the ordered speeds that were measured: from here,
  int fastest = spec::ball::fastest_driven; ///< to here
};

/// TOML, a number a line with its unit. What is read of it is what was written, but for digits
/// beyond the fourth.
std::string to_text(const Profile& profile);

/// The error says which line is wrong and what to write. A row that is missing is the robot's own.
tl::expected<Profile, std::string> parse_profile(std::string_view text);

} // namespace orb::run
