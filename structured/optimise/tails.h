#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Whether two lines that set something or act do the same; a fault must be that of one statement.
bool does_same(const Code& code, const CodeLine& a, const CodeLine& b);

/// What is known of the values of a line that is now run for another, too.
void join_knowledge(Code& code, CodeLine& kept, const CodeLine& other);

/// Ways that do the same before they meet do it once: the lines of one go, and a jump leads it to
/// those of the other. True where there were any.
bool merge_tails(Code& code);

} // namespace orb::structured
