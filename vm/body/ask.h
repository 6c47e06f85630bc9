#pragma once

#include <cstddef>
#include <cstdint>

namespace orb::vm {

/// Who asks. Every ask that can be contended names its actor.
enum class Actor : std::uint8_t { Client, Basic, Macro };
inline constexpr std::size_t actors = 3;

/// What came of an ask. A client is answered "cannot be done now" where it was refused.
enum class Outcome : std::uint8_t { Done, Refused };

} // namespace orb::vm
