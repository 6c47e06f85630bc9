#pragma once

#include "protocol/packet.h"

#include <optional>

namespace orb::protocol {

/// Which way the bytes travel: commands to the ball, answers and async messages from it.
enum class Direction : std::uint8_t { ToBall, FromBall };

/// One thing found in a stream of bytes. The views stay valid until next(), feed() or reset() is
/// called.
struct Item {
  enum class Kind : std::uint8_t {
    Command,
    Response,
    Async,
    Noise,       ///< bytes that begin no packet
    BadChecksum, ///< a packet whose checksum is wrong; its bytes after SOP1 are scanned again
    Fragment     ///< a packet whose rest never came (see Decoder::expire)
  };
  Kind kind = Kind::Noise;
  std::uint8_t flags = 0; ///< SOP2
  std::uint8_t did = 0;   ///< Command
  std::uint8_t cid = 0;   ///< Command
  std::uint8_t code = 0;  ///< Response: MRSP; Async: the id code
  std::uint8_t seq = 0;   ///< Command and Response; of a Fragment where it had arrived
  ByteView data;          ///< the payload
  ByteView raw;           ///< all bytes, start bytes and checksum included

  Command command() const { return {did, cid, seq, flags, {data.begin(), data.end()}}; }
  Response response() const { return {code, seq, {data.begin(), data.end()}}; }
  Async async() const { return {code, {data.begin(), data.end()}}; }
};

/// A packet made here, as a Decoder would find it. `packet` are its bytes; the item's views live as
/// long as both.
Item item_of(const Command& command, ByteView packet);
Item item_of(const Response& response, ByteView packet);
Item item_of(const Async& message, ByteView packet);

/// Finds packets in a stream that arrives in pieces of any size. It resynchronises after noise and
/// damaged packets, never fails, and keeps no more than one incomplete packet between feeds.
///
///   decoder.feed(bytes);
///   while (const auto item = decoder.next())
///     …
class Decoder {
public:
  explicit Decoder(Direction direction) : direction_(direction) {}

  /// Takes a copy of the bytes.
  void feed(ByteView bytes);

  /// The next item, or nothing when more bytes are needed.
  std::optional<Item> next();

  /// Gives up waiting for the rest of an incomplete packet: next() reports it as one Fragment, then
  /// the whole packets and the noise that its bytes hold, until nothing is left. The ball does this
  /// 500 ms after the last byte of a half packet (UPLOAD quirk; spec::fragment_timeout).
  void expire() { expiry_ = Expiry::Due; }

  /// Whether an incomplete packet is waiting for its rest.
  bool pending() const { return at_ < bytes_.size(); }

  /// Forgets everything, as when a link is opened again.
  void reset();

private:
  /// Reported: the fragment was; what else is incomplete among its bytes is noise.
  enum class Expiry : std::uint8_t { No, Due, Reported };
  enum class Match : std::uint8_t { No, Incomplete, Damaged, Whole };

  Match match(ByteView bytes, Item& item) const;
  Match match_command(ByteView bytes, Item& item) const;
  bool is_stray(ByteView bytes) const;
  Match match_answer(ByteView bytes, Item& item) const;

  Direction direction_;
  Expiry expiry_ = Expiry::No;
  Bytes bytes_;        ///< fed, and not consumed before the last feed()
  std::size_t at_ = 0; ///< how far they have been consumed
};

} // namespace orb::protocol
