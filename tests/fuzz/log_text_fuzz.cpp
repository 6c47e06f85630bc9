// Reads logs of any bytes. Every relevant line is either read or counted as a stranger, and what
// was read survives a round trip through a recording.

#include "protocol/log_text.h"
#include "protocol/recording.h"

#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb::protocol;
  const auto log = read_log({reinterpret_cast<const char*>(data), size});
  if (log.lines.size() + log.strangers != log.read_lines)
    std::abort();
  std::string recording;
  for (const auto& line : log.lines)
    recording += recording_line(line.direction.value_or(Direction::ToBall), line.bytes);
  const auto again = read_log(recording);
  if (again.lines.size() != log.lines.size())
    std::abort();
  for (std::size_t i = 0; i < again.lines.size(); ++i)
    if (again.lines[i].bytes != log.lines[i].bytes)
      std::abort();
  return 0;
}
