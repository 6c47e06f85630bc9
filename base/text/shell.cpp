#include "base/text/shell.h"

#include "base/text/text.h"

#include <algorithm>

namespace orb {
namespace {

bool is_plain(char c) {
  return is_letter(c) || is_digit(c) ||
         std::string_view("/._-+=:,@%").find(c) != std::string_view::npos;
}

/// What a POSIX shell still reads between single quotes: only their end.
std::string in_single_quotes(std::string_view word) {
  std::string out = "'";
  for (const char c : word)
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

} // namespace

std::string shell_word(std::string_view word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain))
    return std::string(word);
  // `!` stands for a command of the past where somebody types.
  if (word.find_first_of("\"$`\\!") != std::string_view::npos)
    return in_single_quotes(word);
  return '"' + std::string(word) + '"';
}

} // namespace orb
