// Decodes v2 bytes: every byte comes out exactly once, and a packet encodes to the bytes it was
// read from.

#include "protocol/describe_v2.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  protocol::DecoderV2 decoder;
  protocol::DescriberV2 describer;
  const ByteView bytes(data, size);
  std::size_t seen = 0;
  const auto drain = [&] {
    while (const auto item = decoder.next()) {
      seen += item->raw.size();
      if (describer.describe(*item).empty())
        std::abort();
      if (item->kind == protocol::ItemV2::Kind::Packet && encode(item->packet) != item->raw)
        std::abort();
    }
  };
  decoder.feed(bytes.first(size / 2));
  drain();
  decoder.feed(bytes.subspan(size / 2));
  drain();
  decoder.expire();
  drain();
  if (seen != size)
    std::abort();
  return 0;
}
