#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::vm {

class Ball;

/// What outlives a power cycle as a text file of lines `word hex`: flash program, settings, name,
/// soul block and the counters of a life (docs/protocol.md).
std::string save_state(Ball& ball);

/// Gives a new ball what save_state() wrote. The error is a sentence; the ball is then as it was.
tl::expected<void, std::string> load_state(std::string_view text, Ball& ball);

} // namespace orb::vm
