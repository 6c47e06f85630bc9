#include "base/text/shell.h"

#include "base/text/text.h"

#include <algorithm>

namespace orb {
namespace {

bool is_plain(char c) {
  return is_letter(c) || is_digit(c) ||
         std::string_view("/._-+=:,@%").find(c) != std::string_view::npos;
}

/// Quotes for a POSIX shell. Within single quotes, only the quote itself needs an escape.
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
  // An interactive shell expands `!` from its history.
  if (word.find_first_of("\"$`\\!") != std::string_view::npos)
    return in_single_quotes(word);
  return '"' + std::string(word) + '"';
}

} // namespace orb
