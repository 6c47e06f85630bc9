#pragma once

#include "structured/lift/lifted_values.h"

#include <string>

namespace orb::structured::lifting {

/// The text of a statement that neither calls nor branches, as structured orbBasic.
std::string statement_text(const compiler::Program& program,
                           const compiler::StatementNode& statement, LiftedValues& values);

} // namespace orb::structured::lifting
