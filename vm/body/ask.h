#pragma once

#include <cstddef>
#include <cstdint>

namespace orb::vm {

/// Who makes a request. Every request that may conflict with another names its actor.
enum class Actor : std::uint8_t { Client, Basic, Macro };
inline constexpr std::size_t actors = 3;

/// Result of a request. A client whose request is refused gets the answer "cannot be done now".
enum class Outcome : std::uint8_t { Done, Refused };

} // namespace orb::vm
