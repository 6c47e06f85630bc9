#pragma once

#include "base/bytes.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace orb::vm {

/// A macro compiled into the ball. The vendor's system macros are undocumented; these are harmless
/// ones of our own, so that ids 1 to 31 can be tried.
struct SystemMacro {
  std::uint8_t id = 0;
  std::string_view summary;
  ByteView image; ///< id, flags, body
};

/// Returns all system macros by ascending id.
std::span<const SystemMacro> system_macros();

} // namespace orb::vm
