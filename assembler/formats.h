#pragma once

#include "assembler/assemble.h"
#include "base/source.h"

#include <string>
#include <string_view>

namespace orb::assembler {

/// A byte array for a C program, with its size: the framed macro.
std::string print_c(std::string_view name, const assembler::AssembledMacro& macro);

/// A macro as a document of schema `orb.macro/1`: bytes, commands with their operands, times.
std::string print_macro_json(std::string_view name, const Source& source,
                             const assembler::Assembly& assembly, std::size_t macro);

/// Offset, command number, bytes, times and source, a line a command.
std::string print_listing(std::string_view name, const Source& source,
                          const assembler::Assembly& assembly, std::size_t macro);

} // namespace orb::assembler
