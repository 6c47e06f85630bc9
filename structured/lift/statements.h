#pragma once

#include "structured/lift/values.h"

#include <string>

namespace orb::structured::lifting {

/// A statement that neither calls nor decides what is next, in the words of a structured program.
std::string statement_text(const compiler::Program& program,
                           const compiler::StatementNode& statement, LiftedValues& values);

} // namespace orb::structured::lifting
