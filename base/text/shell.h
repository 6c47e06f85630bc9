#pragma once

#include <string>
#include <string_view>

namespace orb {

/// `word` as the system's shell takes it. Letters, digits and the characters that mean nothing to a
/// shell stay as they are; all else is put into double quotes, which POSIX shells, cmd.exe and
/// PowerShell share, wherever they read them alike.
std::string shell_word(std::string_view word);

} // namespace orb
