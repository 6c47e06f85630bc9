#pragma once

// Private to assembler/.

#include "repair/tokens.h"
#include "spec/macro.h"

// Macro lines as other assemblers, JSON, YAML and people who speak write them.

namespace orb::assembler {

/// A line without the signs of others: labels, keys, brackets, `#90`, `$5A`; a mnemonic in one
/// word.
repair::Tokens own_signs(const repair::Tokens& line);

/// The command that a line means, which then is its first word; null where it means none.
const spec::MacroCommandInfo* command_of(repair::Tokens& line);

/// `jmp`, `goto`: words of which a command that names a macro already says all.
bool is_jump(const repair::Token& token);

} // namespace orb::assembler
