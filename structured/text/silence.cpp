#include "structured/text/silence.h"

#include "base/silence.h"
#include "compiler/text/rules.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"

#include <algorithm>

namespace orb::structured {
namespace {

/// The start of the comment of a line; the end of the line if there is none.
std::uint32_t comment_of(std::string_view text, Span line) {
  bool quoted = false;
  for (auto i = line.begin; i < line.end; ++i) {
    quoted = quoted != (text[i] == '"');
    if (text[i] == '\'' && !quoted)
      return i;
  }
  return line.end;
}

Span line_from(std::string_view text, std::uint32_t begin) {
  auto end = begin;
  while (end < text.size() && !is_line_end(text[end]))
    ++end;
  return {begin, end};
}

/// The next line, whatever its line ending.
Span line_behind(std::string_view text, Span line) {
  const bool pair = text.substr(line.end).starts_with("\r\n");
  const auto begin = line.end + (pair ? 2 : 1);
  return begin < text.size() ? line_from(text, begin) : Span{};
}

std::vector<AllowComment> allow_comments(std::string_view text) {
  std::vector<AllowComment> comments;
  for (auto at = text.find(allow_mark); at != std::string_view::npos;
       at = text.find(allow_mark, at + 1)) {
    auto begin = static_cast<std::uint32_t>(at);
    while (begin > 0 && !is_line_end(text[begin - 1]))
      --begin;
    const auto line = line_from(text, begin);
    const auto comment = comment_of(text, line);
    if (comment > at)
      continue; // the mark is inside a string
    const bool alone = std::all_of(text.begin() + line.begin, text.begin() + comment, is_blank);
    const auto about = alone ? line_behind(text, line) : line;
    comments.push_back({{comment, line.end}, {about.begin, about.end + 1}});
  }
  return comments;
}

/// The rules that apply to a structured program: its own, and those of the compiled program.
const std::vector<Rule>& all_rules() {
  static const auto all = [] {
    std::vector<Rule> both(rules::all().begin(), rules::all().end());
    both.insert(both.end(), compiler::rules::all().begin(), compiler::rules::all().end());
    return both;
  }();
  return all;
}

} // namespace

void silence(Program& program) {
  const auto comments = allow_comments(program.text);
  if (comments.empty())
    return;
  auto& findings = program.diagnostics;
  const auto errors =
      std::stable_partition(findings.begin(), findings.end(),
                            [](const Diagnostic& one) { return one.severity != Severity::Error; });
  std::vector<Diagnostic> kept(std::make_move_iterator(errors),
                               std::make_move_iterator(findings.end()));
  findings.erase(errors, findings.end());
  orb::silence(program.text, comments, all_rules(), compiler::rules::UnknownRule, findings);
  std::move(kept.begin(), kept.end(), std::back_inserter(findings));
}

} // namespace orb::structured
