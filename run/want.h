#pragma once

#include "run/input.h"
#include "run/run.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace orb::run {

/// Something a program waits for that these options never provide.
struct Want {
  std::uint32_t line = 0; ///< the robot's number of the first line that waits
  std::string_view what;  ///< `a shake`
  std::string advice;     ///< the sentence `lack`, extended by the option to type
  std::string lack;       ///< a sentence that says what is missing
  bool answers = false;   ///< it is a number, which a client can give at any time
  std::string_view event; ///< the missing line of a stimulus script without its time: `shake`
};

/// Returns the first thing that the first program waits for, or reads, in vain.
std::optional<Want> want(std::span<const Input> inputs, const Options& options);

} // namespace orb::run
