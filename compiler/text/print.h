#pragma once

#include "compiler/text/program.h"

#include <cstdint>
#include <string>

namespace orb::compiler {

/// The layout of a printed statement.
enum class Layout : std::uint8_t {
  Canonical, ///< `orb fmt`: one space where it helps the reader
  Packed,    ///< no unnecessary space or parentheses, `?` for print
};

/// Prints one statement with its branches. Parsing the result gives the same statement: the text
/// differs only in spaces, leading zeros, `let`, and what `Layout::Packed` omits. A statement that
/// does not parse is returned as written.
std::string print(const Program& program, const StatementNode& statement, Layout layout);

/// Formats a whole source in the canonical layout: comments kept, at most one blank line in a row.
/// Formatting the result again changes nothing.
std::string format(const Program& program);

} // namespace orb::compiler
