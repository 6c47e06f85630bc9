#pragma once

// Names in macro source: macros and constants.

#include "assembler/text/program.h"
#include "base/source.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

inline constexpr std::string_view macro_language_id = "orbmacro";

struct MacroName {
  Span span;
  bool is_definition = false;
};

/// The operand for the value at `index` of a command, found by name or by position.
const spec::MacroOperand* operand_of(const Source& source, const assembler::Program& program,
                                     const assembler::Statement& statement, std::uint32_t index);

/// Finds every place that defines or uses a macro or a constant.
std::vector<MacroName> names_in(const Source& source, const assembler::Program& program);

/// Describes the values of an operand.
std::string range_text(const spec::MacroOperand& operand);

} // namespace orb::editor
