#pragma once

#include "protocol/ble.h"
#include "spec/ble.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::uploader {

/// Why a robot cannot be reached over Bluetooth LE.
enum class BleFailure : std::uint8_t {
  NotBuilt,
  NoSystem, ///< orb does not support this system's Bluetooth LE
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
  Undriven, ///< a known kind that orb does not drive
  NoRobot,
  Refused,
  Held,
  Lost,
  Interrupted
};

struct BleError {
  BleFailure failure{};
  std::string seen;      ///< what happened, in words
  std::string address{}; ///< of the robot, if known
};

/// Returns what helps after a failure: a sentence, or the command to write.
std::string remedy(const BleError& error);

/// Called for each step once, with what was found or why it failed.
using OnBleStep =
    std::function<void(protocol::BleStep step, const tl::expected<std::string, BleError>& found)>;

/// The robot at the other end of a link.
struct BlePeer {
  std::string name; ///< as advertised; empty if it advertises none
  spec::BleProtocol protocol{};
};
/// Called once the link to a robot is open.
using OnBlePeer = std::function<void(const BlePeer&)>;

} // namespace orb::uploader
