#include "base/text/shell.h"

#include "base/text/text.h"

#include <algorithm>

namespace orb {
namespace {

bool is_plain(char c) {
  return is_letter(c) || is_digit(c) ||
         std::string_view("\\/._-+:").find(c) != std::string_view::npos;
}

} // namespace

std::string shell_word(std::string_view word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain))
    return std::string(word);
  // The C runtime splits the command line: a backslash is literal unless a run of them precedes a
  // quote.
  std::string out = "\"";
  std::size_t backslashes = 0;
  for (const char c : word) {
    if (c == '"')
      out.append(backslashes + 1, '\\');
    backslashes = c == '\\' ? backslashes + 1 : 0;
    out += c;
  }
  return out.append(backslashes, '\\') + '"';
}

} // namespace orb
