#pragma once

#include <cstddef>
#include <string_view>

namespace orb {

/// The length of the body as declared by a header.
struct BodyLength {
  enum class Found : unsigned char {
    Nothing,
    Nonsense, ///< not a whole number that fits, or two that differ
    Length
  };
  Found said = Found::Nothing;
  std::size_t bytes = 0; ///< set for a Length
};

/// Reads `Content-Length` from a header whose lines end with CR, LF or both: HTTP (RFC 9110, §8.6)
/// and the editor protocols derived from it. Accepts any bytes.
BodyLength body_length(std::string_view header);

} // namespace orb
