#pragma once

#include "vm/stimulus.h"

#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>

namespace orb::serve {

/// What a line of control asks of served balls: `shake`, `at 2s push 90 120`, `2 reset`, `state`.
struct Control {
  struct Now {
    vm::Stimulus stimulus;
  };
  struct Reset {};
  struct State {};

  std::optional<int> ball;                                 ///< from 1; nothing: all of them
  std::variant<Now, vm::TimedStimulus, Reset, State> what; ///< of a TimedStimulus: since the start
};

/// Reads a line that asks something of one of `balls`; nothing for a blank one or a comment. The
/// error is a sentence that names the line to write.
tl::expected<std::optional<Control>, std::string> parse_control(std::string_view line, int balls);

} // namespace orb::serve
