#include "disk/lock.h"

#include "disk/disk.h"
#include "disk/io.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace orb::disk {
namespace {

constexpr auto retry = std::chrono::milliseconds(5);

/// Returns true if the open file still has that name: its last owner may have removed it.
bool is_still(int fd, const std::string& path) {
  struct stat here {};
  struct stat there {};
  return ::fstat(fd, &here) == 0 && ::stat(path.c_str(), &there) == 0 &&
         here.st_ino == there.st_ino && here.st_dev == there.st_dev;
}

/// The process number written by the holder.
std::string holder(int fd) {
  char text[32] = {};
  const auto size = ::pread(fd, text, sizeof text - 1, 0);
  const std::string_view read(text, size > 0 ? static_cast<std::size_t>(size) : 0);
  return std::string(read.substr(0, read.find('\n')));
}

} // namespace

tl::expected<Lock, IoError> Lock::take(const std::string& path, Duration patience,
                                       std::string_view help) {
  Lock lock;
  const auto place = target_of_links(path);
  struct stat status {};
  if (::stat(place.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    return lock;
  const auto file = place + ".lock";
  const auto until = std::chrono::steady_clock::now() + patience;
  while (true) {
    lock.fd_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (lock.fd_ < 0)
      return failure("lock", path);
    const bool taken = ::flock(lock.fd_, LOCK_EX | LOCK_NB) == 0;
    const int error = taken ? 0 : errno;
    if (taken && is_still(lock.fd_, file))
      break;
    const auto pid = holder(lock.fd_);
    ::close(std::exchange(lock.fd_, -1));
    errno = error;
    if (!taken && error != EWOULDBLOCK && error != EINTR)
      return failure("lock", path);
    if (!taken && std::chrono::steady_clock::now() >= until)
      return tl::unexpected(
          IoError{fmt::format("{} is in use by {}; {}", path,
                              pid.empty() ? "another orb" : "orb, process " + pid, help)});
    std::this_thread::sleep_for(retry);
  }
  lock.file_ = file;
  const auto pid = fmt::format("{}\n", ::getpid());
  if (::ftruncate(lock.fd_, 0) != 0 ||
      ::pwrite(lock.fd_, pid.data(), pid.size(), 0) != static_cast<ssize_t>(pid.size()))
    return failure("write", file);
  return lock;
}

Lock::Lock(Lock&& other) noexcept
    : file_(std::exchange(other.file_, {})), fd_(std::exchange(other.fd_, -1)) {}

Lock& Lock::operator=(Lock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(fd_, other.fd_);
  return *this;
}

Lock::~Lock() {
  if (!file_.empty())
    ::unlink(file_.c_str()); // before unlocking: a waiting process then sees that it is gone
  if (fd_ >= 0)
    ::close(fd_);
}

} // namespace orb::disk
