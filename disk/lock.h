#pragma once

#include "base/io_error.h"
#include "base/time.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::disk {

/// Keeps other processes of orb from a file that this one reads, changes and writes again: a file
/// `NAME.lock` beside it that holds the process number. It ends with its process, however that
/// dies; the file may then stay, and the next one takes it over.
class Lock {
public:
  /// The lock on what `path` leads to. Another process is waited for as long as `patience`; the
  /// error then says which one it is, and `help`. Pipes and devices are not locked.
  static tl::expected<Lock, IoError> take(const std::string& path, Duration patience,
                                          std::string_view help);

  Lock(Lock&& other) noexcept;
  Lock& operator=(Lock&& other) noexcept;
  ~Lock();

private:
  Lock() = default;

  std::string file_;
  int fd_ = -1;
};

} // namespace orb::disk
