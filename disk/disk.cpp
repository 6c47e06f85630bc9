#include "disk/disk.h"

#include "base/texts.h"
#include "disk/io.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace orb::disk {
namespace {

/// Closes a descriptor at the end of the scope.
class Descriptor {
public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0)
      ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

private:
  int fd_;
};

/// Returns true for an inherited descriptor: /dev/stdin, or /dev/fd/63 of a shell's `<(command)`.
bool is_descriptor(const std::string& path) {
  return path.starts_with("/dev/") || path.starts_with("/proc/");
}

mode_t default_mode() {
  const auto mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

tl::expected<void, IoError> overwrite(const std::string& path, ByteView bytes) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !write_all(file.get(), bytes))
    return failure("write", path);
  struct stat status {};
  if (::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode) &&
      (::ftruncate(file.get(), static_cast<off_t>(bytes.size())) != 0 || ::fsync(file.get()) != 0))
    return failure("write", path);
  return {};
}

/// Writes a file beside `path` and renames it. `before` describes the file it replaces; null if
/// there is none.
tl::expected<void, IoError> replace(const std::string& path, ByteView bytes,
                                    const struct stat* before) {
  std::string temporary = path + ".XXXXXX";
  const Descriptor file(::mkstemp(temporary.data()));
  if (file.get() < 0)
    return failure("write", path);
  if (before != nullptr && ::fchown(file.get(), before->st_uid, before->st_gid) != 0) {
    ::unlink(temporary.c_str());
    return overwrite(path, bytes); // a file of another owner that we may write to
  }
  const auto mode = before != nullptr ? before->st_mode & 07777 : default_mode();
  const bool written = write_all(file.get(), bytes) && ::fchmod(file.get(), mode) == 0 &&
                       ::fsync(file.get()) == 0 && ::rename(temporary.c_str(), path.c_str()) == 0;
  if (!written) {
    const int error = errno;
    ::unlink(temporary.c_str());
    errno = error;
    return failure("write", path);
  }
  return {};
}

} // namespace

Message what_else(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return {};
  if (S_ISFIFO(status.st_mode))
    return texts::APipe();
  if (S_ISDIR(status.st_mode))
    return texts::AFolder();
  if (S_ISSOCK(status.st_mode))
    return texts::ASocket();
  return S_ISREG(status.st_mode) && !is_descriptor(path) ? Message() : texts::ADevice();
}

tl::expected<std::string, IoError> read(const std::string& path) {
  if (path == "-")
    return read_descriptor(STDIN_FILENO, display_name(path));
  if (!is_descriptor(path) && what_else(path).is(texts::APipe))
    return tl::unexpected(IoError{
        fmt::format("cannot read {0}: it is a pipe; `- <{0}` reads it as standard input", path)});
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0)
    return failure("read", path);
  return read_descriptor(file.get(), path);
}

tl::expected<void, IoError> write(const std::string& path, ByteView bytes) {
  if (path == "-") {
    if (!write_all(STDOUT_FILENO, bytes))
      return failure("write", "<stdout>");
    return {};
  }
  const auto place = target_of_links(path);
  struct stat status {};
  const bool exists = ::stat(place.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    return failure("write", path);
  }
  // Renaming would ignore write protection of the file.
  if (exists ? ::access(place.c_str(), W_OK) != 0 : errno != ENOENT)
    return failure("write", path);
  // Devices and pipes (/dev/stdout) cannot be replaced, and replacing a file with several names
  // would detach the others.
  if (exists && (!S_ISREG(status.st_mode) || status.st_nlink > 1))
    return overwrite(place, bytes);
  return replace(place, bytes, exists ? &status : nullptr);
}

// A draft.

tl::expected<Draft, IoError> Draft::of(const std::string& path) {
  Draft draft(path == "-" ? path : target_of_links(path));
  struct stat status {};
  const bool exists = path == "-" || ::stat(draft.path_.c_str(), &status) == 0;
  if (exists && path != "-" && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    return failure("write", path);
  }
  if (path != "-" && (exists ? ::access(draft.path_.c_str(), W_OK) != 0 : errno != ENOENT))
    return failure("write", path);
  if (path == "-" || (exists && !S_ISREG(status.st_mode)))
    return draft;
  draft.beside_ = draft.path_ + ".XXXXXX";
  draft.fd_ = ::mkostemp(draft.beside_.data(), O_CLOEXEC);
  if (draft.fd_ < 0) {
    draft.beside_.clear();
    return failure(exists ? "write next to" : "write", path);
  }
  return draft;
}

Draft::~Draft() {
  if (fd_ < 0)
    return;
  ::close(fd_);
  if (!beside_.empty())
    ::unlink(beside_.c_str());
}

tl::expected<void, IoError> Draft::move_to(const std::string& path) {
  struct stat before {};
  const bool exists = ::lstat(path.c_str(), &before) == 0;
  // Renaming would lose other names or another owner.
  const bool in_place = exists && (!S_ISREG(before.st_mode) || before.st_nlink > 1 ||
                                   ::fchown(fd_, before.st_uid, before.st_gid) != 0);
  if (error_ == 0 && in_place) {
    const auto text = read(beside_);
    if (!text)
      return tl::unexpected(text.error());
    return overwrite(path, as_bytes(*text));
  }
  const auto mode = exists ? before.st_mode & 07777 : default_mode();
  if (error_ == 0 && ::fchmod(fd_, mode) == 0 && ::fsync(fd_) == 0 &&
      ::rename(beside_.c_str(), path.c_str()) == 0) {
    beside_.clear();
    return {};
  }
  if (error_ != 0)
    errno = error_;
  return failure("write", path);
}

tl::expected<void, IoError> Draft::publish() {
  return fd_ < 0 ? write(path_, held_) : move_to(path_);
}

tl::expected<std::optional<std::string>, IoError> Draft::keep_beside() {
  const bool free = fd_ < 0 || ::access(path_.c_str(), F_OK) != 0;
  const auto place = free ? path_ : path_ + ".failed";
  if (const auto kept = free ? publish() : move_to(place); !kept)
    return tl::unexpected(kept.error());
  return free ? std::nullopt : std::optional(place);
}

} // namespace orb::disk
