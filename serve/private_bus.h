#pragma once

#include "base/io_error.h"

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <tl/expected.hpp>

namespace orb::serve {

/// A D-Bus of our own: a dbus-daemon in a folder that is removed at the end.
class PrivateBus {
public:
  PrivateBus() = default;
  PrivateBus(const PrivateBus&) = delete;
  PrivateBus& operator=(const PrivateBus&) = delete;
  ~PrivateBus();

  /// Starts it. Whom nobody may call is named in `denied`; empty for nobody.
  tl::expected<void, IoError> start(std::string_view denied);

  /// As programs take it from the environment: `unix:path=…`.
  std::string address() const;

private:
  std::filesystem::path folder_;
  pid_t daemon_ = -1;
};

} // namespace orb::serve
