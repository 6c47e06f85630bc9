#pragma once

#include "base/io_error.h"
#include "base/time.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::disk {

/// Keeps other orb processes away from a file during a read-modify-write cycle: a file `NAME.lock`
/// beside it that holds the process number. The lock ends with the process, however that dies; a
/// file left behind is taken over by the next process.
class Lock {
public:
  /// Locks the target of `path`. Waits for another process up to `patience`; the error then names
  /// that process and ends in `help`. Pipes and devices are not locked.
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
