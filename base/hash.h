#pragma once

#include <cstdint>
#include <string_view>

namespace orb {

/// Hashes a text (FNV-1a); the value is the same on every platform and never changes. Not for
/// secrets.
constexpr std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 14695981039346656037u;
  for (const char c : text)
    value = (value ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return value;
}

} // namespace orb
