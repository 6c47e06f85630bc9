#include "testing/text/layout.h"

#include "base/text/lines.h"
#include "base/text/text.h"

#include <algorithm>
#include <vector>

namespace orb::testing {
namespace {

constexpr std::size_t step = 2; // spaces of indentation

/// Returns the end of the text or pattern that begins at `begin` with `mark`; the end of the line
/// if it is not closed.
std::size_t end_of_quoted(std::string_view line, std::size_t begin, char mark) {
  auto at = begin + 1;
  while (at < line.size() && line[at] != mark)
    at += line[at] == '\\' && mark == '/' ? 2 : 1;
  return std::min(at + 1, line.size());
}

/// True if a colour such as `#FF8000` begins here, not a comment.
bool is_color(std::string_view text) {
  constexpr std::size_t digits = 6;
  const auto end = text.find_first_not_of("0123456789abcdefABCDEF", 1);
  return std::min(end, text.size()) == digits + 1 && (end == text.npos || is_blank(text[end]));
}

/// Returns the words of a line with one space between them, and two before a comment.
std::string respaced(std::string_view line) {
  std::string out;
  bool begins = true; // a word begins here
  for (std::size_t at = 0; at < line.size();) {
    const char c = line[at];
    if (is_blank(c)) {
      begins = true;
      ++at;
      continue;
    }
    const bool is_comment = c == '#' && !is_color(line.substr(at));
    if (!out.empty() && (begins || is_comment))
      out += is_comment ? "  " : " ";
    auto end = at + 1;
    if (is_comment)
      end = line.size();
    else if (c == '"' || (begins && c == '/'))
      end = end_of_quoted(line, at, c);
    out += line.substr(at, end - at);
    begins = false;
    at = end;
  }
  return out;
}

bool is_test(std::string_view line) {
  return line == "test" || line.starts_with("test ") || line.starts_with("test\"");
}

} // namespace

std::string layout(std::string_view text) {
  std::string out;
  bool in_test = false;
  bool wants_gap = false;         // before what comes next
  std::vector<std::string> above; // unindented comments, which may belong to the next test
  const auto write = [&](std::string_view line, std::size_t indent) {
    if (wants_gap && !out.empty())
      out += '\n';
    wants_gap = false;
    out.append(indent, ' ').append(line) += '\n';
  };
  const auto write_above = [&] {
    for (const auto& comment : above)
      write(comment, 0);
    above.clear();
  };
  while (!text.empty()) {
    const auto raw = take_line(text);
    const auto line = respaced(trim(raw));
    if (line.empty()) {
      write_above();
      wants_gap = true;
    } else if (line.front() == '#' && !is_blank(raw.front())) {
      above.push_back(line);
    } else if (is_test(line)) {
      in_test = true;
      wants_gap = true;
      write_above();
      write(line, 0);
    } else {
      write_above();
      const std::size_t depth = (in_test ? 1U : 0U) + (line.front() == '"' ? 1U : 0U);
      write(line, depth * step);
    }
  }
  write_above();
  return out;
}

} // namespace orb::testing
