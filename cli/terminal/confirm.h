#pragma once

#include "base/exit_code.h"

#include <string_view>
#include <tl/expected.hpp>

namespace orb::cli {

/// Asks for Enter on standard error and waits. Fails with ExitCode::Interrupted on Ctrl-C, and with
/// ExitCode::Usage if standard input ends; `remedy` then says what to write instead.
tl::expected<void, Failure> await_enter(std::string_view remedy);

} // namespace orb::cli
