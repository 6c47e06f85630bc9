#pragma once

#include "compiler/program.h"

#include <string>
#include <string_view>

namespace orb::cli {

/// What a newcomer may be missing when a run ended for `reason` (as in the trace) without a
/// stimulus script: a sentence, or nothing where there is nothing to say.
std::string run_hint(std::string_view reason, const compiler::Program& program);

} // namespace orb::cli
