#pragma once

#include "base/exit_code.h"

#include <string_view>
#include <tl/expected.hpp>

namespace orb::cli {

/// Asks for Enter on standard error and waits for it. Ctrl-C is ExitCode::Interrupted; where
/// standard input ends first it is ExitCode::Usage, with `remedy` for what to write instead.
tl::expected<void, Failure> await_enter(std::string_view remedy);

} // namespace orb::cli
