#pragma once

#include <string>
#include <tl/expected.hpp>

namespace orb {

/// Why a file could not be read or written: the sentence to print.
struct IoError {
  std::string message;
};

} // namespace orb
