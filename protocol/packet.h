#pragma once

#include "base/bytes.h"
#include "spec/api.h"

namespace orb::protocol {

/// A request to the ball. Source: API §Client Command Packets.
struct Command {
  std::uint8_t did = 0;
  std::uint8_t cid = 0;
  std::uint8_t seq = 0; ///< repeated in the answer
  /// The SOP2 byte: F8h to FFh. Its low bits ask for an answer and reset the inactivity timer.
  std::uint8_t flags = spec::sop2_default;
  Bytes data{};

  friend bool operator==(const Command&, const Command&) = default;
};

/// The ball's answer to one command. Source: API §Sphero Response Packets.
struct Response {
  std::uint8_t code = 0; ///< spec::ResponseCode, or an undocumented value
  std::uint8_t seq = 0;
  Bytes data{}; ///< at most spec::max_payload bytes

  friend bool operator==(const Response&, const Response&) = default;
};

/// An unsolicited message from the ball. Source: API §Sphero Asynchronous Packets.
struct Async {
  std::uint8_t id = 0; ///< spec::AsyncId, or an undocumented value
  Bytes data{};        ///< at most spec::max_async_payload bytes

  friend bool operator==(const Async&, const Async&) = default;
};

/// Makes a command from the table, with the default SOP2.
Command make_command(spec::ApiCommand command, Bytes data = {}, std::uint8_t seq = 0);

/// Returns the checksum from DID (or MRSP, or ID code) to the end of the data: the sum modulo 256,
/// every bit inverted.
std::uint8_t checksum(ByteView bytes);

/// Returns true if a payload of this size fits a command packet: up to spec::max_payload bytes, or
/// exactly the longer fixed payload of a few commands (DLEN FFh).
bool fits(std::uint8_t did, std::uint8_t cid, std::size_t payload_size);

/// Appends the packet's bytes to `out`. Truncates a payload that does not fit (see fits()).
void encode(const Command& command, Bytes& out);
void encode(const Response& response, Bytes& out);
void encode(const Async& async, Bytes& out);

Bytes encode(const Command& command);
Bytes encode(const Response& response);
Bytes encode(const Async& async);

} // namespace orb::protocol
