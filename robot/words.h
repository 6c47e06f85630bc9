#pragma once

#include "robot/robot.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// Robots described in words, for bindings to other languages. All errors are sentences.

namespace orb::robot {

/// `Options` in words and plain numbers.
struct Words {
  std::string name;
  std::uint64_t seed = 1;
  double x_cm = 0;
  double y_cm = 0;
  double heading_deg = 0;
  std::string firmware; ///< empty: the default
  std::string fault;    ///< for example `drop=1%,delay=50..300ms`; empty: a good link
  Keep keep = Keep::Journey;
};

/// `there is no robot `blot`; did you mean `bolt`?`, or which there are.
std::string no_such(std::string_view what, std::string_view name,
                    const std::vector<std::string_view>& names);

tl::expected<Options, std::string> read_options(const Words& words);

/// Returns the kind called `name`, for example `bolt`.
tl::expected<spec::Robot, std::string> read_kind(std::string_view name);

/// Parses the walls and zones of a drawing; an empty text has none.
tl::expected<report::Course, std::string> read_course(const std::string& drawing);

/// Converts a time in seconds, at most a hundred years.
tl::expected<Duration, std::string> read_seconds(double seconds);

/// The Bluetooth LE profile of a kind of robot.
struct Gatt {
  struct Characteristic {
    std::string_view service; ///< UUIDs of 36 characters
    std::string_view uuid;
    std::string_view summary;
    std::uint8_t can; ///< of spec::ble_can
    std::string_view
        value; ///< what a read returns; empty if that is the robot's name, address or battery
  };
  struct Word {
    std::string_view uuid;
    std::string_view bytes;
  };
  std::string_view name_prefix;                 ///< `SB-`
  std::string_view protocol;                    ///< `v1` or `v2`
  std::vector<Characteristic> characteristics;  ///< in the order of their handles
  std::vector<Word> greeting;                   ///< to be written before the first command
  bool is_deaf = false;                         ///< it answers nothing before the first of them
  std::optional<std::chrono::seconds> patience; ///< without a greeting it ends the link after this
  std::string_view commands_uuid;
  std::string_view answers_uuid;
  std::string_view advertised_service; ///< empty for none
  std::optional<int> advertised_power; ///< dBm
  std::optional<int> advertised_maker;
};

/// What can be done with a characteristic, in the words of clients: `read`,
/// `write-without-response`, …
std::vector<std::string_view> properties(std::uint8_t can);
Gatt gatt(spec::Robot kind);

} // namespace orb::robot
