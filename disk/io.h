#pragma once

#include "disk/disk.h"

// What disk.h is made of on every system.

namespace orb::disk {

/// Says why an action failed, from errno, and what helps.
tl::unexpected<IoError> failure(std::string_view action, const std::string& path);

/// All that comes from a descriptor; `name` is for errors.
tl::expected<std::string, IoError> read_descriptor(int fd, const std::string& name);

/// Whether all went out; else errno says why not.
bool write_all(int fd, ByteView bytes);

} // namespace orb::disk
