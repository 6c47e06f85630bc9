#pragma once

#include <cstddef>
#include <string_view>

namespace orb {

/// What a header says of the length of the body behind it.
struct BodyLength {
  enum class Said : unsigned char {
    Nothing,
    Nonsense, ///< no whole number that fits, or two that differ
    Length
  };
  Said said = Said::Nothing;
  std::size_t bytes = 0; ///< of a Length
};

/// Reads `Content-Length` among the lines of a header, which end with CR, LF or both: of HTTP
/// (RFC 9110, §8.6), and of the protocols of editors, which took it from there. Any bytes may come.
BodyLength body_length(std::string_view header);

} // namespace orb
