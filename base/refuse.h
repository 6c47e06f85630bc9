#pragma once

#include "base/exit_code.h"

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace orb {

/// Wraps a failure as the result of an operation.
inline tl::unexpected<Failure> refuse(ExitCode code, std::string message) {
  return tl::unexpected(Failure{code, std::move(message)});
}

} // namespace orb
