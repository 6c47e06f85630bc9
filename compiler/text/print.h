#pragma once

#include "compiler/text/program.h"

#include <cstdint>
#include <string>

namespace orb::compiler {

/// How a statement is written out.
enum class Layout : std::uint8_t {
  Canonical, ///< `orb fmt`: one blank where blanks help the reader
  Packed,    ///< no blank that is not needed, no parentheses that do nothing, `?` for print
};

/// Writes one statement, branches included. Reading it back gives the same statement: the text only
/// differs in blanks, leading zeros, `let`, and what `Layout::Packed` leaves out. A statement that
/// does not parse comes back as it was written.
std::string print(const Program& program, const StatementNode& statement, Layout layout);

/// The canonical layout of a whole source: one line each, comments kept, blank lines at most one in
/// a row. Formatting the result again changes nothing.
std::string format(const Program& program);

} // namespace orb::compiler
