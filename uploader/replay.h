#pragma once

#include "protocol/recording.h"

#include <memory>
#include <string>

namespace orb::uploader {

/// Opens `replay://`: a recording in a file.
tl::expected<std::unique_ptr<protocol::Transport>, protocol::LinkError>
open_replay(const std::string& path);

} // namespace orb::uploader
