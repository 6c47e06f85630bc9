#pragma once

#include "base/io_error.h"

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <tl/expected.hpp>

namespace orb::serve {

/// A private D-Bus: a dbus-daemon in a folder that is removed at the end.
class PrivateBus {
public:
  PrivateBus() = default;
  PrivateBus(const PrivateBus&) = delete;
  PrivateBus& operator=(const PrivateBus&) = delete;
  ~PrivateBus();

  /// Starts it. Calls to the name `denied` are refused; empty: none.
  tl::expected<void, IoError> start(std::string_view denied);

  /// Returns `unix:path=…`, the form used in the environment.
  std::string address() const;

private:
  std::filesystem::path folder_;
  pid_t daemon_ = -1;
};

} // namespace orb::serve
