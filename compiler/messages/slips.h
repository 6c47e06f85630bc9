#pragma once

#include "base/diagnostic.h"
#include "compiler/text/program.h"

#include <optional>

namespace orb::compiler {

/// What somebody who comes from another language most likely meant where a line does not parse,
/// with the line to write; nothing where no habit fits. Private to compiler/.
std::optional<Diagnostic> explain_slip(const Program& program, const Fault& fault);

} // namespace orb::compiler
