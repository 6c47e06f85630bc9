#include "disk/lock.h"

#include "disk/disk.h"

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <io.h>
#include <thread>
#include <utility>
#include <windows.h>

namespace orb::disk {
namespace {

constexpr auto retry = std::chrono::milliseconds(5);

/// Opens a file exclusively for writing; it is deleted with its handle.
HANDLE open_alone(const std::string& file) {
  return ::CreateFileW(as_path(file).c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_READ, nullptr,
                       CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
}

} // namespace

tl::expected<Lock, IoError> Lock::take(const std::string& path, Duration patience,
                                       std::string_view help) {
  Lock lock;
  const auto place = target_of_links(path);
  if (!what_else(place).empty())
    return lock;
  const auto file = place + ".lock";
  const auto until = std::chrono::steady_clock::now() + patience;
  while (true) {
    const auto handle = open_alone(file);
    if (handle != INVALID_HANDLE_VALUE) {
      lock.fd_ = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), 0);
      lock.file_ = file;
      return lock;
    }
    const auto error = ::GetLastError();
    // A file that its owner has just released may still be pending deletion: access is then denied.
    const bool in_use = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED;
    if (!in_use)
      return tl::unexpected(IoError{fmt::format("cannot lock {}: error {}", path, error)});
    if (std::chrono::steady_clock::now() >= until)
      return tl::unexpected(IoError{fmt::format("{} is in use by another orb; {}", path, help)});
    std::this_thread::sleep_for(retry);
  }
}

Lock::Lock(Lock&& other) noexcept
    : file_(std::exchange(other.file_, {})), fd_(std::exchange(other.fd_, -1)) {}

Lock& Lock::operator=(Lock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(fd_, other.fd_);
  return *this;
}

Lock::~Lock() {
  if (fd_ >= 0)
    ::_close(fd_);
}

} // namespace orb::disk
