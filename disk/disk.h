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

/// Reads the whole content of `path`; `-` is standard input. Refuses directories, unreadable files
/// and named pipes, which might never get a writer.
tl::expected<std::string, IoError> read(const std::string& path);

/// Writes `bytes` to the target of `path`, completely or not at all. Keeps mode, owner and other
/// names, if necessary by writing in place. `-` is standard output.
tl::expected<void, IoError> write(const std::string& path, ByteView bytes);

/// A file written piece by piece that replaces another only at the end. Until then the appended
/// bytes are stored beside it, where they survive a kill. Pipes and devices receive everything at
/// the end.
class Draft {
public:
  /// Prepares to write the target of `path`, which is not touched yet. Fails if it is not writable.
  static tl::expected<Draft, IoError> of(const std::string& path);

  Draft(Draft&& other) noexcept;
  Draft& operator=(Draft&& other) noexcept;
  /// Removes the bytes stored beside it.
  ~Draft();

  /// Appends bytes. A failure is reported later, by publish() or keep_beside().
  void append(ByteView bytes);
  /// Replaces the file.
  tl::expected<void, IoError> publish();
  /// If the file existed before, keeps it, stores the draft as `NAME.failed` and returns that path.
  /// Otherwise the draft becomes the file.
  tl::expected<std::optional<std::string>, IoError> keep_beside();
  bool empty() const { return size_ == 0; }

private:
  explicit Draft(std::string path) : path_(std::move(path)) {}
  tl::expected<void, IoError> move_to(const std::string& path);

  std::string path_;
  std::string beside_; ///< path of the bytes; empty: in memory
  int fd_ = -1;
  int error_ = 0; ///< errno of the first failed append
  std::size_t size_ = 0;
  Bytes held_;
};

/// Names what `path` is if not a file: `a pipe`, `a folder`, `a device`, `a socket`. Empty for a
/// file, or if nothing exists there.
Message what_else(const std::string& path);

/// Resolves symbolic links, even to a target that does not exist yet.
std::string target_of_links(std::string path);

/// Converts UTF-8 to a path. On Windows std::filesystem would interpret narrow characters in
/// another encoding.
std::filesystem::path as_path(std::string_view path);

/// Returns the name of a file in messages: its path, or `<stdin>` for `-`.
std::string display_name(const std::string& path);

} // namespace orb::disk
