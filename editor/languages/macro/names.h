#pragma once

// The names of macro source: macros and constants.

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

/// The operand that the value at `index` of a command is for: by name, else by its place.
const spec::MacroOperand* operand_of(const Source& source, const assembler::Program& program,
                                     const assembler::Statement& statement, std::uint32_t index);

/// Every place that defines or uses a macro's or a constant's name.
std::vector<MacroName> names_in(const Source& source, const assembler::Program& program);

/// What an operand takes, in words.
std::string range_text(const spec::MacroOperand& operand);

} // namespace orb::editor
