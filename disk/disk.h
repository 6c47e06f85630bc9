#pragma once

#include "base/bytes.h"
#include "base/io_error.h"
#include "base/message.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace orb::disk {

/// The whole content of `path`; `-` is standard input. Directories and unreadable files are errors,
/// and pipes that have a name: nobody may ever write into them.
tl::expected<std::string, IoError> read(const std::string& path);

/// Writes `bytes` to what `path` leads to, whole or not at all; mode, owner and other names stay
/// (in place, where they would be lost). `-` is standard output.
tl::expected<void, IoError> write(const std::string& path, ByteView bytes);

/// A file that is written bit by bit and takes the place of another only at the end: what was there
/// before stays until then. What has been appended lies beside it, so it outlives a kill. Pipes and
/// devices get all of it at the end, in one go.
class Draft {
public:
  /// For what `path` leads to, which is not touched yet. Fails where it could not be written.
  static tl::expected<Draft, IoError> of(const std::string& path);

  Draft(Draft&& other) noexcept;
  Draft& operator=(Draft&& other) noexcept;
  /// Leaves nothing behind.
  ~Draft();

  /// A failure is kept, and told by publish() or keep_beside().
  void append(ByteView bytes);
  /// Becomes the file.
  tl::expected<void, IoError> publish();
  /// Becomes `NAME.failed`, whose path it returns, where the file was there before, which stays;
  /// else the file.
  tl::expected<std::optional<std::string>, IoError> keep_beside();
  bool empty() const { return size_ == 0; }

private:
  explicit Draft(std::string path) : path_(std::move(path)) {}
  tl::expected<void, IoError> move_to(const std::string& path);

  std::string path_;
  std::string beside_; ///< where the bytes are; empty for in memory
  int fd_ = -1;
  int error_ = 0; ///< errno of the first append that failed
  std::size_t size_ = 0;
  Bytes held_;
};

/// What is at `path` if it is not a file: `a pipe`, `a folder`, `a device`, `a socket`. Empty for a
/// file, and for nothing.
Message what_else(const std::string& path);

/// What links at `path` lead to, even where that is not there yet.
std::string target_of_links(std::string path);

/// The path that a text in UTF-8 names. Where std::filesystem takes narrow characters for those of
/// some other encoding, on Windows, it would not be that one.
std::filesystem::path as_path(std::string_view path);

/// How a file is called in messages: its path, or `<stdin>` for `-`.
std::string display_name(const std::string& path);

} // namespace orb::disk
