#pragma once

#include <cstdint>

namespace orb {

/// A small seeded generator (SplitMix64). It gives the same numbers with every compiler, which the
/// standard distributions do not promise. Not for secrets.
struct Random {
  static constexpr std::uint64_t stride = 0x9E3779B97F4A7C15ULL;

  std::uint64_t state = 1;

  static constexpr std::uint64_t mix(std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
    return value ^ (value >> 31);
  }

  constexpr std::uint64_t next() {
    state += stride;
    return mix(state);
  }

  /// Returns a number from 0 to `bound` - 1; `bound` must not be 0. The bias is below bound / 2^64.
  constexpr std::uint64_t below(std::uint64_t bound) { return next() % bound; }

  /// Returns true with the given probability, 0 to 1.
  constexpr bool chance(double probability) {
    return static_cast<double>(next() >> 11) < probability * 9007199254740992.0; // 2^53
  }
};

} // namespace orb
