#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::vm {

class Ball;

/// Returns everything kept across power cycles as lines `word hex`: flash program, settings, name,
/// soul block and lifetime counters (docs/reference/protocol.md).
std::string save_state(Ball& ball);

/// Restores into a new ball what save_state() wrote. The error is a sentence; the ball is then
/// unchanged.
tl::expected<void, std::string> load_state(std::string_view text, Ball& ball);

} // namespace orb::vm
