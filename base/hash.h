#pragma once

#include <cstdint>
#include <string_view>

namespace orb {

/// Tells texts apart, the same everywhere and for ever (FNV-1a); not for secrets.
constexpr std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 14695981039346656037u;
  for (const char c : text)
    value = (value ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return value;
}

} // namespace orb
