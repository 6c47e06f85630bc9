#pragma once

#include "vm/stimulus.h"

#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>

namespace orb::serve {

/// A control line for served balls: `shake`, `at 2s push 90 120`, `2 reset`, `state`.
struct Control {
  struct Now {
    vm::Stimulus stimulus;
  };
  struct Reset {};
  struct StateQuery {};

  std::optional<int> ball;                                      ///< from 1; nullopt: all balls
  std::variant<Now, vm::TimedStimulus, Reset, StateQuery> what; ///< TimedStimulus: since the start
};

/// Parses a control line for one of `balls`; nullopt for a blank line or comment. The error is a
/// sentence that names the line to write.
tl::expected<std::optional<Control>, std::string> parse_control(std::string_view line, int balls);

} // namespace orb::serve
