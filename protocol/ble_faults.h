#pragma once

#include "base/time.h"
#include "protocol/ble.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::protocol {

/// What is wrong with a robot's Bluetooth LE, or with that of the computer. What is wrong with the
/// packets that pass over it is a FaultPlan.
struct BleFaultPlan {
  std::size_t pieces_least = spec::ble_piece_bytes; ///< bytes of a notification, drawn
  std::size_t pieces_most = spec::ble_piece_bytes;
  std::size_t links = 0; ///< how many robots the adapter holds; 0 for any number
  Duration late{};       ///< before the services are known after a connection
  Duration interval{};   ///< before a written piece is acknowledged
  double lose = 0;       ///< the share of notifications that are lost
  double refuse = 0; ///< … of written pieces that are not acknowledged; every other one arrives
  std::optional<BleStep> drop;      ///< the link is lost in this step, every time
  std::optional<BleStep> drop_once; ///< … the first time
  std::optional<BleStep> balk;      ///< this step fails every time, and the link stays
  std::optional<BleStep> balk_once; ///< … the first time
  std::optional<BleStep> vanish;    ///< the adapter is pulled out in this step
  bool no_daemon = false;           ///< there is no bluetoothd
  bool no_adapter = false;
  bool adapter_off = false;
  bool denied = false;   ///< the user may not speak to bluetoothd
  bool away = false;     ///< the robot is not near
  bool held = false;     ///< another program has its notifications
  bool newer = false;    ///< it has the characteristics of the newer protocol
  bool undriven = false; ///< it is of a kind that orb does not drive
  bool mute = false;     ///< it answers nothing
  std::uint64_t seed = 1;
};

/// Reads `pieces=1..20,late=2s,drop@services,lose=1%,seed=7`; the error is a sentence that names
/// the word which is wrong and the words there are.
tl::expected<BleFaultPlan, std::string> parse_ble_fault_plan(std::string_view text);

} // namespace orb::protocol
