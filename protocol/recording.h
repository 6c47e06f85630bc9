#pragma once

#include "protocol/decoder.h"
#include "protocol/transport.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::protocol {

/// One write or read of a recorded conversation.
struct RecordedPiece {
  Direction direction = Direction::ToBall;
  Bytes bytes;
};

/// Parses a recording: `> FF FF …` was sent, `< FF FF …` was received, `#` begins a comment. A time
/// may precede, as in `1.234 > FF FF …`. Leading and trailing blanks are ignored. The error is a
/// sentence that names the line.
tl::expected<std::vector<RecordedPiece>, std::string> parse_recording(std::string_view text);

/// Returns a line of a recording, with its line end.
std::string recording_line(Direction direction, ByteView bytes);

/// Observes all writes and reads of a link.
class WireListener {
public:
  virtual ~WireListener() = default;
  virtual void on_bytes(Direction direction, ByteView bytes, Instant now) = 0;
};

/// A Transport that passes another one through and reports its traffic to a listener, which must
/// outlive it.
class RecordingTransport final : public Transport {
public:
  RecordingTransport(std::unique_ptr<Transport> inner, WireListener& listener)
      : inner_(std::move(inner)), listener_(listener) {}

  Instant now() const override { return inner_->now(); }
  tl::expected<void, LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, LinkError> read(Instant deadline) override;

private:
  std::unique_ptr<Transport> inner_;
  WireListener& listener_;
};

/// Plays the ball's side of a recording. Writes must equal those recorded, byte for byte; the first
/// difference is an error. A client that only listens receives the rest of the ball's output. Time
/// is virtual.
class ReplayTransport final : public Transport {
public:
  explicit ReplayTransport(std::vector<RecordedPiece> pieces) : pieces_(std::move(pieces)) {}

  Instant now() const override { return now_; }
  tl::expected<void, LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, LinkError> read(Instant deadline) override;

private:
  std::vector<RecordedPiece> pieces_;
  std::size_t next_ = 0;    ///< index of the next piece
  std::size_t written_ = 0; ///< bytes of it already written
  std::uint64_t total_ = 0; ///< bytes written, for messages
  Bytes unread_;            ///< what arrived before the last write
  Duration waited_{};       ///< time waited for a write since the last traffic
  Instant now_{};
};

/// Returns the sequence number of the first packet sent in the recording: a session that repeats it
/// must begin with the same one.
std::optional<std::uint8_t> first_recorded_seq(const std::vector<RecordedPiece>& pieces);

} // namespace orb::protocol
