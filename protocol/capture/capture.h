#pragma once

#include "protocol/capture/frames.h"
#include "protocol/conversation.h"

#include <vector>

namespace orb::protocol {

/// The conversations of robots and clients in a Bluetooth capture.
struct Capture {
  Frames frames;                           ///< views into the file
  std::vector<Conversation> conversations; ///< in the order of their first lines
};

/// Reads btsnoop, pcap and pcapng, recognised by content; nullopt for other files. Accepts any
/// bytes and skips what it cannot read. Times are seconds since the first frame.
std::optional<Capture> read_capture(ByteView file);

} // namespace orb::protocol
