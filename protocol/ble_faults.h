#pragma once

#include "base/time.h"
#include "protocol/ble.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::protocol {

/// Faults of a robot's Bluetooth LE, or of the computer's. FaultPlan covers faults of the packets
/// that pass over it. Large because each fault is a field and can be combined with the others.
struct BleFaultPlan {
  std::size_t pieces_least = spec::ble_piece_bytes; ///< random size of a notification in bytes
  std::size_t pieces_most = spec::ble_piece_bytes;
  std::size_t links = 0; ///< most robots that the adapter can hold; 0: no limit
  Duration late{};       ///< delay until the services are known after connecting
  Duration interval{};   ///< delay until a written piece is acknowledged
  double lose = 0;       ///< share of notifications that are lost
  double refuse = 0;     ///< share of written pieces not acknowledged; every other one arrives
  std::optional<BleStep> drop;      ///< lose the link in this step, every time
  std::optional<BleStep> drop_once; ///< … only the first time
  std::optional<BleStep> balk;      ///< fail this step every time, but keep the link
  std::optional<BleStep> balk_once; ///< … only the first time
  std::optional<BleStep> vanish;    ///< unplug the adapter in this step
  bool no_daemon = false;           ///< bluetoothd is missing
  bool no_adapter = false;
  bool adapter_off = false;
  bool denied = false;   ///< the user has no permission to use bluetoothd
  bool away = false;     ///< the robot is out of range
  bool held = false;     ///< another program is subscribed to its answers
  bool newer = false;    ///< it has the characteristics of the newer protocol
  bool undriven = false; ///< it is of a kind that orb does not drive
  bool mute = false;     ///< it never answers
  std::uint64_t seed = 1;
};

/// Parses `pieces=1..20,late=2s,drop@services,lose=1%,seed=7`. The error is a sentence that names
/// the wrong word and lists the valid ones.
tl::expected<BleFaultPlan, std::string> parse_ble_fault_plan(std::string_view text);

} // namespace orb::protocol
