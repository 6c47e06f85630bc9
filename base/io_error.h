#pragma once

#include <string>
#include <tl/expected.hpp>

namespace orb {

/// The sentence to print if a file cannot be read or written.
struct IoError {
  std::string message;
};

} // namespace orb
