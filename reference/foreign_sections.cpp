#include "reference/foreign_sections.h"

#include "base/text/text.h"
#include "repair/idioms.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::reference {
namespace {

using repair::Language;

struct Way {
  Language language;
  std::string_view name;
};
constexpr Way ways[] = {{Language::Structured, "structured"},
                        {Language::Basic, "numbered"},
                        {Language::Macro, "macro"}};

/// Arguments that such a word usually has, the likeliest first.
constexpr std::string_view calls[] = {"{}(90)", "{}(0, 80, 2)", "{}(255, 0, 0)", "{}(\"hello\")",
                                      "{}(90, 2)"};

/// True if a rewrite says something new, not just the same word or leftover parentheses.
bool is_answer(const repair::Tokens& line, const repair::Candidate& one, Language language) {
  const auto tokens = repair::tokens_of(one.text, language);
  return std::none_of(tokens.begin(), tokens.end(), [&](const repair::Token& token) {
    return token.is("(") || equal_words(token.text, line.front().text);
  });
}

/// The rewrite by the first pattern that matches `line`.
std::optional<repair::Candidate> here(std::string_view line, Language language) {
  const auto tokens = repair::tokens_of(line, language);
  if (tokens.empty() || !tokens.front().is_word())
    return std::nullopt;
  repair::Surroundings around;
  around.language = language;
  std::optional<repair::Candidate> found;
  repair::rewrite(tokens, around, [&](const repair::Candidate& one) {
    if (!is_answer(tokens, one, language))
      return false;
    found = one;
    return true;
  });
  return found;
}

std::string advise(std::string_view line, Language language) {
  repair::Surroundings around;
  around.language = language;
  around.line_number = "100";
  return in_english(repair::advise(repair::tokens_of(line, language), around));
}

/// Joins several lines into one.
std::string beside(std::string_view lines) {
  std::string all;
  for (const char c : lines)
    all += c == '\n' ? "; " : std::string(1, c);
  return all;
}

std::optional<Entry> explain_line(std::string_view line) {
  Entry entry;
  entry.name = line;
  entry.summary = "is written differently here";
  for (const auto& way : ways)
    if (const auto found = here(line, way.language)) {
      entry.facts.emplace_back(way.name, beside(found->text));
      if (found->why != nullptr)
        entry.summary = in_english({*found->why, {}});
    } else if (auto advice = advise(line, way.language); !advice.empty()) {
      entry.facts.emplace_back(way.name, std::move(advice));
    }
  if (entry.facts.empty())
    return std::nullopt;
  return entry;
}

} // namespace

std::optional<Section> foreign_knowledge(std::string_view text) {
  const bool is_word = text.find('(') == std::string_view::npos;
  std::optional<Entry> entry;
  for (const auto call : calls)
    if (is_word && !entry)
      entry = explain_line(fmt::format(fmt::runtime(call), text));
  if (!entry)
    entry = explain_line(text);
  if (!entry)
    return std::nullopt;
  return Section{"foreign", "Other languages", "another language", {std::move(*entry)}, {}};
}

} // namespace orb::reference
