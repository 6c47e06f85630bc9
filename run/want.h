#pragma once

#include "run/input.h"
#include "run/run.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace orb::run {

/// What a program looks for in the world that these options do not bring about.
struct Want {
  std::uint32_t line = 0; ///< the robot's number of the first line that looks
  std::string_view what;  ///< `a shake`
  std::string advice;     ///< a sentence that says so and ends in the option to type
  std::string lack;       ///< the sentence alone
  bool answers = false;   ///< a number, which a client can give anywhere
  std::string_view event; ///< what is missing as a line of a stimulus script, but its time: `shake`
};

/// The first thing that the first program waits for, or reads, in vain.
std::optional<Want> want(std::span<const Input> inputs, const Options& options);

} // namespace orb::run
