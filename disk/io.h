#pragma once

#include "disk/disk.h"

// Shared by the implementations of disk.h on all systems.

namespace orb::disk {

/// Describes errno after a failed action, with what helps.
tl::unexpected<IoError> failure(std::string_view action, const std::string& path);

/// Reads everything from a descriptor; `name` is used in errors.
tl::expected<std::string, IoError> read_descriptor(int fd, const std::string& name);

/// Returns true if everything was written; otherwise errno says why not.
bool write_all(int fd, ByteView bytes);

} // namespace orb::disk
