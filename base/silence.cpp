#include "base/silence.h"

#include "base/rules.h"
#include "base/texts.h"

#include <algorithm>

namespace orb {
namespace {

struct Allowed {
  const Rule* rule;
  Span about;
};

/// The names after the mark, separated by spaces or commas.
std::vector<Span> names_in(std::string_view text, Span comment) {
  constexpr std::string_view blanks = " ,\t\r";
  const auto line = text.substr(0, comment.end);
  std::vector<Span> names;
  auto end = line.find(allow_mark, comment.begin) + allow_mark.size();
  while (true) {
    const auto begin = line.find_first_not_of(blanks, end);
    if (begin == std::string_view::npos)
      return names;
    end = std::min(line.find_first_of(blanks, begin), line.size());
    names.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
  }
}

} // namespace

void silence(std::string_view text, std::span<const AllowComment> comments,
             std::span<const Rule> table, const Rule& unknown, std::vector<Diagnostic>& findings) {
  std::vector<Allowed> allowed;
  for (const auto& [comment, about] : comments)
    for (const auto span : names_in(text, comment)) {
      const auto name = text.substr(span.begin, span.size());
      if (const auto* rule = find_rule(table, name))
        allowed.push_back({rule, about});
      else
        findings.push_back(finding(unknown, span, texts::UnknownRule(name)));
    }
  std::erase_if(findings, [&](const Diagnostic& d) {
    return std::any_of(allowed.begin(), allowed.end(), [&](const Allowed& entry) {
      return entry.rule->id == d.rule->id && entry.about.begin <= d.span.begin &&
             d.span.begin < entry.about.end;
    });
  });
}

} // namespace orb
