#include "disk/disk.h"

#include "base/texts.h"
#include "disk/io.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <unistd.h>
#include <windows.h>

namespace orb::disk {
namespace {

namespace fs = std::filesystem;

constexpr int mode = _S_IREAD | _S_IWRITE;

int open(const std::string& path, int flags) {
  return ::_wopen(as_path(path).c_str(), flags | _O_BINARY | _O_NOINHERIT, mode);
}

/// Creates a file with an unused name beside `path` and changes `path` to it.
int open_beside(std::string& path) {
  constexpr int tries = 1000;
  for (int i = 0; i < tries; ++i) {
    const auto name =
        fmt::format("{}.{:06x}", path, (::GetCurrentProcessId() * tries + i) & 0xFFFFFF);
    const int fd = open(name, _O_RDWR | _O_CREAT | _O_EXCL);
    if (fd >= 0 || errno != EEXIST) {
      path = name;
      return fd;
    }
  }
  return -1;
}

/// Renames `from` to `to` atomically. A process that reads the file briefly, such as a virus
/// scanner, blocks that, so it is retried for a while.
bool replace(const std::string& from, const std::string& to) {
  constexpr int tries = 50;
  constexpr DWORD pause_ms = 20;
  for (int i = 0; i < tries; ++i) {
    if (::MoveFileExW(as_path(from).c_str(), as_path(to).c_str(),
                      MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0)
      return true;
    const auto error = ::GetLastError();
    if (error != ERROR_SHARING_VIOLATION && error != ERROR_ACCESS_DENIED)
      break;
    ::Sleep(pause_ms);
  }
  errno = EACCES;
  return false;
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(as_path(path), error);
}

/// Device names are not paths: `NUL`, `CON`, `COM5`.
bool is_device(const std::string& path) {
  std::error_code error;
  return fs::is_other(as_path(path), error) || fs::is_character_file(as_path(path), error);
}

} // namespace

Message what_else(const std::string& path) {
  return is_folder(path) ? texts::AFolder() : is_device(path) ? texts::ADevice() : Message();
}

tl::expected<std::string, IoError> read(const std::string& path) {
  if (path == "-")
    return read_descriptor(STDIN_FILENO, display_name(path));
  if (is_folder(path)) {
    errno = EISDIR;
    return failure("read", path);
  }
  const int fd = open(path, _O_RDONLY);
  if (fd < 0)
    return failure("read", path);
  auto text = read_descriptor(fd, path);
  ::_close(fd);
  return text;
}

tl::expected<void, IoError> write(const std::string& path, ByteView bytes) {
  if (path == "-") {
    if (!write_all(STDOUT_FILENO, bytes))
      return failure("write", "<stdout>");
    return {};
  }
  auto draft = Draft::of(path);
  if (!draft)
    return tl::unexpected(draft.error());
  draft->append(bytes);
  return draft->publish();
}

// A draft.

tl::expected<Draft, IoError> Draft::of(const std::string& path) {
  Draft draft(path == "-" ? path : target_of_links(path));
  if (path == "-" || is_device(draft.path_))
    return draft;
  if (is_folder(draft.path_)) {
    errno = EISDIR;
    return failure("write", path);
  }
  const auto place = as_path(draft.path_);
  if (::_waccess(place.c_str(), F_OK) == 0 && ::_waccess(place.c_str(), W_OK) != 0)
    return failure("write", path);
  draft.beside_ = draft.path_;
  draft.fd_ = open_beside(draft.beside_);
  if (draft.fd_ < 0) {
    draft.beside_.clear();
    return failure("write", path);
  }
  return draft;
}

Draft::~Draft() {
  if (fd_ < 0)
    return;
  ::_close(fd_);
  if (!beside_.empty())
    ::_wunlink(as_path(beside_).c_str());
}

tl::expected<void, IoError> Draft::move_to(const std::string& path) {
  const bool closed = ::_commit(fd_) == 0 && ::_close(fd_) == 0;
  fd_ = -1;
  if (closed && error_ == 0 && disk::replace(beside_, path)) {
    beside_.clear();
    return {};
  }
  if (error_ != 0)
    errno = error_;
  auto why = failure("write", path);
  ::_wunlink(as_path(beside_).c_str());
  return why;
}

tl::expected<void, IoError> Draft::publish() {
  if (fd_ >= 0)
    return move_to(path_);
  if (path_ == "-")
    return write(path_, held_);
  const int fd = open(path_, _O_WRONLY);
  const bool written = fd >= 0 && write_all(fd, held_);
  if (fd >= 0)
    ::_close(fd);
  if (!written)
    return failure("write", path_);
  return {};
}

tl::expected<std::optional<std::string>, IoError> Draft::keep_beside() {
  const bool free = fd_ < 0 || ::_waccess(as_path(path_).c_str(), F_OK) != 0;
  const auto place = free ? path_ : path_ + ".failed";
  if (const auto kept = free ? publish() : move_to(place); !kept)
    return tl::unexpected(kept.error());
  return free ? std::nullopt : std::optional(place);
}

} // namespace orb::disk
