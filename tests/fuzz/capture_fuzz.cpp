// Reads captures of any bytes: each conversation has lines, in frame order, and no frame is
// invented.

#include "protocol/capture/capture.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const auto capture = protocol::read_capture({data, size});
  if (!capture)
    return 0;
  if (capture->frames.packets.size() > capture->frames.count || capture->frames.count > size)
    std::abort();
  for (const auto& conversation : capture->conversations) {
    std::size_t before = 0;
    if (conversation.lines.empty())
      std::abort();
    for (const auto& line : conversation.lines) {
      if (line.number < before || line.number > capture->frames.count || !line.at)
        std::abort();
      before = line.number;
    }
  }
  return 0;
}
