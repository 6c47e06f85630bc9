#pragma once

#include "protocol/packet.h"

#include <optional>

namespace orb::protocol {

/// Direction of bytes: commands to the ball, answers and async messages from it.
enum class Direction : std::uint8_t { ToBall, FromBall };

/// An item found in a stream of bytes. Its views are valid until the next call of next(), feed() or
/// reset().
struct Item {
  enum class Kind : std::uint8_t {
    Command,
    Response,
    Async,
    Noise,       ///< bytes outside any packet
    BadChecksum, ///< a packet with a wrong checksum; its bytes after SOP1 are scanned again
    Fragment     ///< a packet without its end (see Decoder::expire)
  };
  Kind kind = Kind::Noise;
  std::uint8_t flags = 0; ///< SOP2
  std::uint8_t did = 0;   ///< Command
  std::uint8_t cid = 0;   ///< Command
  std::uint8_t code = 0;  ///< Response: MRSP; Async: the id code
  std::uint8_t seq = 0;   ///< Command and Response; also a Fragment that contains it
  ByteView data;          ///< the payload
  ByteView raw;           ///< all bytes, including start bytes and checksum

  Command command() const { return {did, cid, seq, flags, {data.begin(), data.end()}}; }
  Response response() const { return {code, seq, {data.begin(), data.end()}}; }
  Async async() const { return {code, {data.begin(), data.end()}}; }
};

/// Converts a packet made here to an item, as a Decoder would return it. `packet` contains its
/// bytes; the item's views require both arguments to stay alive.
Item item_of(const Command& command, ByteView packet);
Item item_of(const Response& response, ByteView packet);
Item item_of(const Async& message, ByteView packet);

/// Returns how many bytes belong to whole v1 packets of that direction.
std::size_t understood(ByteView bytes, Direction direction);

/// Finds packets in a stream that arrives in pieces of any size. Resynchronises after noise and
/// damaged packets, never fails, and keeps at most one incomplete packet between feeds.
///
///  decoder.feed(bytes);
///  while (const auto item = decoder.next())
///    …
class Decoder {
public:
  explicit Decoder(Direction direction) : direction_(direction) {}

  /// Copies the bytes.
  void feed(ByteView bytes);

  /// Returns the next item; nullopt if more bytes are needed.
  std::optional<Item> next();

  /// Stops waiting for the rest of an incomplete packet: next() reports it as one Fragment, then
  /// the whole packets and noise among its bytes. The ball does this 500 ms after the last byte of
  /// an incomplete packet (UPLOAD quirk; spec::fragment_timeout).
  void expire() { expiry_ = Expiry::Due; }

  /// Returns true while an incomplete packet waits for its rest.
  bool pending() const { return at_ < bytes_.size(); }

  /// Discards all state, for example when a link is reopened.
  void reset();

private:
  /// Reported: the fragment was reported, and other incomplete bytes in it count as noise.
  enum class Expiry : std::uint8_t { No, Due, Reported };
  enum class Match : std::uint8_t { No, Incomplete, Damaged, Whole };

  Match match(ByteView bytes, Item& item) const;
  Match match_command(ByteView bytes, Item& item) const;
  bool is_stray(ByteView bytes) const;
  Match match_answer(ByteView bytes, Item& item) const;

  Direction direction_;
  Expiry expiry_ = Expiry::No;
  Bytes bytes_;        ///< fed, and not consumed before the last feed()
  std::size_t at_ = 0; ///< bytes consumed
};

} // namespace orb::protocol
