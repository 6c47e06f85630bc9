#pragma once

#include "base/bytes.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// Why a file could not be read or written: the sentence to print.
struct IoError {
  std::string message;
};

/// The whole content of `path`; `-` is standard input. Directories and unreadable files are errors.
tl::expected<std::string, IoError> read_file(const std::string& path);

/// Writes `bytes` to `path` whole or not at all: a temporary file beside it, fsync, rename.
/// `-` is standard output.
tl::expected<void, IoError> write_file(const std::string& path, ByteView bytes);

/// How a file is called in messages: its path, or `<stdin>` for `-`.
std::string display_name(const std::string& path);

} // namespace orb::cli
