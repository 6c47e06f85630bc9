#include "protocol/recording.h"

#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::protocol {
namespace {

/// A client that has not written for this long only listens: no client waits as long.
constexpr Duration only_listens = 1h;

std::string wrong_line(std::size_t line) {
  return fmt::format("line {} is not `> FF FF …` (sent) or `< FF FF …` (received)", line);
}

} // namespace

tl::expected<std::vector<RecordedPiece>, std::string> parse_recording(std::string_view text) {
  std::vector<RecordedPiece> pieces;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto end = std::min(text.find('\n'), text.size());
    auto content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    content.remove_prefix(std::min(content.find_first_not_of(" \t\r"), content.size()));
    if (content.empty() || content.front() == '#')
      continue;
    if (is_digit(content.front())) // skip the time
      content = trim(content.substr(std::min(content.find_first_of(" \t"), content.size())));
    if (content.empty())
      return tl::unexpected(wrong_line(line));
    const auto bytes = from_hex(content.substr(1));
    if ((content.front() != '>' && content.front() != '<') || !bytes)
      return tl::unexpected(wrong_line(line));
    if (!bytes->empty())
      pieces.push_back({content.front() == '>' ? Direction::ToBall : Direction::FromBall, *bytes});
  }
  return pieces;
}

std::string recording_line(Direction direction, ByteView bytes) {
  return fmt::format("{} {}\n", direction == Direction::ToBall ? '>' : '<', to_hex(bytes));
}

tl::expected<void, LinkError> RecordingTransport::write(ByteView bytes) {
  listener_.on_bytes(Direction::ToBall, bytes, now());
  return inner_->write(bytes);
}

tl::expected<Bytes, LinkError> RecordingTransport::read(Instant deadline) {
  auto read = inner_->read(deadline);
  if (read && !read->empty())
    listener_.on_bytes(Direction::FromBall, *read, now());
  return read;
}

tl::expected<void, LinkError> ReplayTransport::write(ByteView bytes) {
  waited_ = {};
  for (const auto byte : bytes) {
    for (; next_ < pieces_.size() && pieces_[next_].direction == Direction::FromBall; ++next_)
      unread_.insert(unread_.end(), pieces_[next_].bytes.begin(), pieces_[next_].bytes.end());
    if (next_ == pieces_.size())
      return tl::unexpected(LinkError{
          LinkError::Kind::Mismatch,
          fmt::format("the recording ends before sent byte {} ({:02X}h)", total_ + 1, byte)});
    const auto expected = pieces_[next_].bytes[written_];
    if (byte != expected)
      return tl::unexpected(LinkError{
          LinkError::Kind::Mismatch,
          fmt::format("sent byte {} is {:02X}h, but the recording has {:02X}h there; it was "
                      "made with different files or options",
                      total_ + 1, byte, expected)});
    ++total_;
    if (++written_ == pieces_[next_].bytes.size()) {
      written_ = 0;
      ++next_;
    }
  }
  return {};
}

tl::expected<Bytes, LinkError> ReplayTransport::read(Instant deadline) {
  if (!unread_.empty())
    return std::exchange(unread_, {});
  while (next_ < pieces_.size() && pieces_[next_].direction == Direction::ToBall) {
    const auto wait = deadline == never ? only_listens : std::max(deadline - now_, Duration{});
    if (waited_ + wait < only_listens) {
      waited_ += wait;
      now_ += wait;
      return Bytes{};
    }
    ++next_;
    written_ = 0;
  }
  if (next_ == pieces_.size())
    return tl::unexpected(LinkError{LinkError::Kind::Ended, "the recording ends here"});
  return pieces_[next_++].bytes;
}

std::optional<std::uint8_t> first_recorded_seq(const std::vector<RecordedPiece>& pieces) {
  Bytes sent;
  for (const auto& piece : pieces)
    if (piece.direction == Direction::ToBall)
      sent.insert(sent.end(), piece.bytes.begin(), piece.bytes.end());
  Decoder decoder(Direction::ToBall);
  decoder.feed(sent);
  while (const auto item = decoder.next())
    if (item->kind == Item::Kind::Command)
      return item->seq;
  return std::nullopt;
}

} // namespace orb::protocol
