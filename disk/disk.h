#pragma once

#include "base/bytes.h"
#include "base/io_error.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::disk {

/// The whole content of `path`; `-` is standard input. Directories and unreadable files are errors.
tl::expected<std::string, IoError> read(const std::string& path);

/// Writes `bytes` to what `path` leads to, whole or not at all; mode, owner and other names stay
/// (in place, where they would be lost). `-` is standard output.
tl::expected<void, IoError> write(const std::string& path, ByteView bytes);

/// Makes sure that `path` can be written later, and empties it. A pipe is left alone: opened and
/// closed again it would be at its end for whoever reads from it.
tl::expected<void, IoError> prepare(const std::string& path);

/// How a file is called in messages: its path, or `<stdin>` for `-`.
std::string display_name(const std::string& path);

} // namespace orb::disk
