#pragma once

#include "protocol/decoder.h"
#include "protocol/transport.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::uploader {

/// One write or read of a recorded conversation.
struct RecordedPiece {
  protocol::Direction direction = protocol::Direction::ToBall;
  Bytes bytes;
};

/// Reads a recording: `> FF FF …` was sent, `< FF FF …` was received, `#` begins a comment. The
/// error is a sentence that names the line.
tl::expected<std::vector<RecordedPiece>, std::string> parse_recording(std::string_view text);

/// A line of a recording, with its line end.
std::string recording_line(protocol::Direction direction, ByteView bytes);

/// Hears every write and read of a link.
class WireListener {
public:
  virtual ~WireListener() = default;
  virtual void on_bytes(protocol::Direction direction, ByteView bytes, Instant now) = 0;
};

/// A Transport around a Transport that tells a listener what passes; the listener must outlive it.
class RecordingTransport final : public protocol::Transport {
public:
  RecordingTransport(std::unique_ptr<protocol::Transport> inner, WireListener& listener)
      : inner_(std::move(inner)), listener_(listener) {}

  Instant now() const override { return inner_->now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

private:
  std::unique_ptr<protocol::Transport> inner_;
  WireListener& listener_;
};

/// Plays the ball's side of a recording. What is written must be what was sent then, byte for byte;
/// the first other byte is an error. Time is virtual.
class ReplayTransport final : public protocol::Transport {
public:
  explicit ReplayTransport(std::vector<RecordedPiece> pieces) : pieces_(std::move(pieces)) {}

  Instant now() const override { return now_; }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

private:
  std::vector<RecordedPiece> pieces_;
  std::size_t next_ = 0;    ///< the piece that comes next
  std::size_t written_ = 0; ///< bytes of it that have been written
  std::uint64_t total_ = 0; ///< bytes written, for messages
  Instant now_{};
};

/// Opens `replay://`.
tl::expected<std::unique_ptr<protocol::Transport>, protocol::LinkError>
open_replay(const std::string& path);

/// The sequence number of the first packet that was sent in the recording: a session that is to
/// repeat it must begin with the same.
std::optional<std::uint8_t> first_recorded_seq(const std::vector<RecordedPiece>& pieces);

} // namespace orb::uploader
