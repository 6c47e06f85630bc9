#pragma once

#include "base/time.h"
#include "protocol/decoder.h"
#include "spec/robots.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace orb::protocol {

/// The bytes of one write or read.
struct LogLine {
  std::string when;                   ///< time as written in the log; may be empty
  std::optional<Direction> direction; ///< if the log tells
  Bytes bytes;
  std::optional<Duration> at{}; ///< time since an arbitrary moment; nullopt if unknown
  std::size_t number = 0;       ///< line of the text or frame of the capture, from 1
  bool greets = false;          ///< a greeting that opens a robot (spec/ble.def), not packets
};

/// The carrier of the packets.
enum class Carrier : std::uint8_t { Unknown, Gatt, Rfcomm };

/// The traffic between one robot and its client during a connection.
struct Conversation {
  std::string robot;               ///< its address; empty if the log does not tell
  std::optional<spec::Robot> kind; ///< if the log tells
  Carrier carrier = Carrier::Unknown;
  bool has_start = false; ///< the log includes the start of the connection
  bool has_end = false;   ///< … and its end
  bool has_lock = false;  ///< the robot requires a greeting, as far as the log tells
  std::vector<LogLine> lines;
};

} // namespace orb::protocol
