// Reads body lengths in headers of any bytes, and messages framed by them. The result must not
// depend on how the stream is cut.

#include "base/text/header_fields.h"
#include "editor/wire.h"

#include <cstdlib>
#include <string>
#include <string_view>

namespace {

/// Returns all that the reader finds if `bytes` arrive in two pieces.
std::string read(std::string_view bytes, std::size_t cut) {
  orb::editor::MessageReader reader;
  std::string found;
  for (const auto piece : {bytes.substr(0, cut), bytes.substr(cut)}) {
    reader.feed(piece);
    while (const auto event = reader.next())
      if (!event->is_error)
        found += event->text + '\0';
  }
  return found;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using Found = orb::BodyLength::Found;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto length = orb::body_length(text);
  if (length.said != Found::Length && length.bytes != 0)
    std::abort();
  const auto again = orb::body_length("Content-Length: " + std::to_string(length.bytes) + "\r\n" +
                                      std::string(text));
  const auto expected = length.said == Found::Nothing ? Found::Length : length.said;
  if (again.said != expected || again.bytes != length.bytes)
    std::abort();
  const auto whole = read(text, size);
  if (text.size() < orb::editor::MessageReader::max_header && read(text, size / 2) != whole)
    std::abort();
  return 0;
}
