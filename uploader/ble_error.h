#pragma once

#include "protocol/ble.h"
#include "spec/ble.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::uploader {

/// Why there is no way to a robot over Bluetooth LE.
enum class BleFailure : std::uint8_t {
  NotBuilt,
  NoSystem, ///< this system's Bluetooth LE is not spoken to
  NotLoaded,
  NoBus,
  NoDaemon,
  NotAllowed,
  NoAdapter,
  AdapterOff,
  AdapterGone,
  NotFound,
  Ambiguous,
  NotConnected,
  NotResolved,
  Undriven, ///< it is known, and orb does not drive it
  NoRobot,
  Refused,
  Held,
  Lost,
  Interrupted
};

struct BleError {
  BleFailure failure{};
  std::string seen;      ///< what happened, in words
  std::string address{}; ///< of the robot, where it is known
};

/// What helps after a failure: a sentence, or the command to write.
std::string remedy(const BleError& error);

/// Hears of each step to a robot once: what was found, or why it ends there.
using OnBleStep =
    std::function<void(protocol::BleStep step, const tl::expected<std::string, BleError>& found)>;

/// A robot at the other end of a link.
struct BlePeer {
  std::string name; ///< as it advertises it; empty where it tells none
  spec::BleProtocol protocol{};
};
/// Hears of the robot once the link to it is open.
using OnBlePeer = std::function<void(const BlePeer&)>;

} // namespace orb::uploader
