#include "uploader/replay.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace orb::uploader {

using protocol::LinkError;

tl::expected<std::unique_ptr<protocol::Transport>, LinkError> open_replay(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad())
    return tl::unexpected(
        LinkError{LinkError::Kind::CannotOpen,
                  fmt::format("cannot read {}; `--record FILE` makes a recording", path)});
  auto pieces = protocol::parse_recording(text);
  if (!pieces)
    return tl::unexpected(
        LinkError{LinkError::Kind::CannotOpen, fmt::format("{}: {}", path, pieces.error())});
  return std::make_unique<protocol::ReplayTransport>(std::move(*pieces));
}

} // namespace orb::uploader
