#pragma once

#include "base/bytes.h"
#include "spec/api.h"

namespace orb::protocol {

/// A request to the ball. Source: API §Client Command Packets.
struct Command {
  std::uint8_t did = 0;
  std::uint8_t cid = 0;
  std::uint8_t seq = 0; ///< echoed in the answer
  /// The SOP2 byte: F8h to FFh, whose low bits ask for an answer and reset the inactivity timer.
  std::uint8_t flags = spec::sop2_default;
  Bytes data{};

  friend bool operator==(const Command&, const Command&) = default;
};

/// The ball's answer to one command. Source: API §Sphero Response Packets.
struct Response {
  std::uint8_t code = 0; ///< spec::ResponseCode, or a value that no document names
  std::uint8_t seq = 0;
  Bytes data{}; ///< at most spec::max_payload bytes

  friend bool operator==(const Response&, const Response&) = default;
};

/// A message that the ball sends unasked. Source: API §Sphero Asynchronous Packets.
struct Async {
  std::uint8_t id = 0; ///< spec::AsyncId, or a value that no document names
  Bytes data{};        ///< at most spec::max_async_payload bytes

  friend bool operator==(const Async&, const Async&) = default;
};

/// A command from the table, with the default SOP2.
Command make_command(spec::ApiCommand command, Bytes data = {}, std::uint8_t seq = 0);

/// The checksum byte over DID (or MRSP, or ID code) up to the end of the data: the sum modulo 256,
/// every bit inverted.
std::uint8_t checksum(ByteView bytes);

/// Whether a payload of this size fits a command packet: up to spec::max_payload bytes, or exactly
/// the fixed longer payload of the few commands that have one (DLEN FFh).
bool fits(std::uint8_t did, std::uint8_t cid, std::size_t payload_size);

/// Appends the packet's bytes to `out`. The payload must fit (see above): what is beyond is cut.
void encode(const Command& command, Bytes& out);
void encode(const Response& response, Bytes& out);
void encode(const Async& async, Bytes& out);

Bytes encode(const Command& command);
Bytes encode(const Response& response);
Bytes encode(const Async& async);

} // namespace orb::protocol
