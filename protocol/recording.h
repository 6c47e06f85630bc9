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

/// Reads a recording: `> FF FF …` was sent, `< FF FF …` was received, `#` begins a comment. A
/// time may stand in front, as in `1.234 > FF FF …`. Blanks in front and at the end do not count.
/// The error is a sentence that names the line.
tl::expected<std::vector<RecordedPiece>, std::string> parse_recording(std::string_view text);

/// A line of a recording, with its line end.
std::string recording_line(Direction direction, ByteView bytes);

/// Hears every write and read of a link.
class WireListener {
public:
  virtual ~WireListener() = default;
  virtual void on_bytes(Direction direction, ByteView bytes, Instant now) = 0;
};

/// A Transport around a Transport that tells a listener what passes; the listener must outlive it.
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

/// Plays the ball's side of a recording. What is written must be what was sent then, byte for byte;
/// the first other byte is an error. A client that only listens hears the rest of what the ball
/// said. Time is virtual.
class ReplayTransport final : public Transport {
public:
  explicit ReplayTransport(std::vector<RecordedPiece> pieces) : pieces_(std::move(pieces)) {}

  Instant now() const override { return now_; }
  tl::expected<void, LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, LinkError> read(Instant deadline) override;

private:
  std::vector<RecordedPiece> pieces_;
  std::size_t next_ = 0;    ///< the piece that comes next
  std::size_t written_ = 0; ///< bytes of it that have been written
  std::uint64_t total_ = 0; ///< bytes written, for messages
  Bytes unread_;            ///< what had come before the last write
  Duration waited_{};       ///< for a write, since the last thing that passed
  Instant now_{};
};

/// The sequence number of the first packet that was sent in the recording: a session that is to
/// repeat it must begin with the same.
std::optional<std::uint8_t> first_recorded_seq(const std::vector<RecordedPiece>& pieces);

} // namespace orb::protocol
