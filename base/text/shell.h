#pragma once

#include <string>
#include <string_view>

namespace orb {

/// Quotes `word` for the system's shell. Letters, digits and characters without a meaning to a
/// shell stay. The rest goes into double quotes where POSIX shells, cmd.exe and PowerShell read
/// them alike.
std::string shell_word(std::string_view word);

} // namespace orb
