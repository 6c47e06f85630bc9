// Decodes v1 bytes in both directions. Whatever arrives, in whatever pieces, packets come out in
// order and at most one incomplete packet is kept.

#include "protocol/describe.h"

#include <algorithm>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  if (size == 0)
    return 0;
  const auto direction =
      (data[0] & 1) != 0 ? protocol::Direction::ToBall : protocol::Direction::FromBall;
  const std::size_t piece = 1 + (data[0] >> 1);
  const ByteView bytes(data + 1, size - 1);
  protocol::Decoder decoder(direction);
  protocol::Describer describer;
  std::size_t seen = 0;
  const auto drain = [&] {
    while (const auto item = decoder.next()) {
      if (describer.describe(*item).empty())
        std::abort();
      const auto scanned_again = item->kind == protocol::Item::Kind::BadChecksum ||
                                 item->kind == protocol::Item::Kind::Fragment;
      seen += scanned_again ? 1 : item->raw.size();
    }
  };
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    decoder.feed(bytes.subspan(at, std::min(piece, bytes.size() - at)));
    drain();
  }
  decoder.expire();
  drain();
  if (seen != bytes.size() || decoder.pending())
    std::abort(); // a byte was lost or invented
  return 0;
}
