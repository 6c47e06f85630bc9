#include "editor/languages/shape.h"

#include "base/text/text.h"
#include "editor/languages/markdown.h"
#include "reference/sections.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor {
namespace {

constexpr std::int64_t second_ms = 1000;

std::string_view arrow(std::int64_t heading_deg) {
  constexpr auto arrows = std::to_array<std::string_view>({"↑", "↗", "→", "↘", "↓", "↙", "←", "↖"});
  constexpr std::int64_t circle = 360;
  constexpr std::int64_t sector = circle / static_cast<std::int64_t>(arrows.size());
  const auto turned = ((heading_deg % circle) + circle + sector / 2) % circle;
  return arrows[static_cast<std::size_t>(turned / sector)];
}

} // namespace

std::vector<Colored> Palette::take() {
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Colored& a, const Colored& b) { return a.span.begin < b.span.begin; });
  std::vector<Colored> kept;
  for (const auto& one : found_)
    if (kept.empty() || kept.back().span.end <= one.span.begin)
      kept.push_back(one);
  found_.clear();
  return kept;
}

void color_token(Palette& palette, const Token& token) {
  switch (token.kind) {
  case TokenKind::Number: palette.add(token.span, Color::Number); break;
  case TokenKind::String: palette.add(token.span, Color::String); break;
  case TokenKind::Comment: palette.add(token.span, Color::Comment); break;
  case TokenKind::Word:
  case TokenKind::Sign: break;
  }
}

void color_statement(Palette& palette, Span span, const spec::StatementInfo& row) {
  if (directs_the_flow(row))
    palette.add(span, Color::Keyword);
  else
    palette.add(span, Color::Function, Robots);
}

void color_system(Palette& palette, Span span, const spec::VariableInfo& row) {
  palette.add(span, Color::Variable,
              Robots | (row.access == spec::Access::ReadWrite ? Plain : Fixed));
}

std::vector<Fold> comment_folds(const Source& source, char comment) {
  std::vector<Fold> folds;
  std::uint32_t first = 0;
  for (std::uint32_t line = 1; line <= source.line_count() + 1; ++line) {
    if (trim(source.line(line)).starts_with(comment)) {
      if (first == 0)
        first = line;
      continue;
    }
    if (first != 0 && line - first > 1)
      folds.push_back({first, line - 1, true});
    first = 0;
  }
  return folds;
}

void add_fold(std::vector<Fold>& folds, const Source& source, std::uint32_t first,
              std::uint32_t last) {
  last = std::min(last, source.line_count());
  while (last > first && trim(source.line(last)).empty())
    --last;
  if (last > first)
    folds.push_back({first, last, false});
}

std::vector<Span> nested(const Source& source, std::uint32_t offset, std::vector<Span> spans) {
  const auto line = source.position(offset).line;
  const auto end = end_of_line(source, offset);
  auto begin = source.line_start(line);
  while (begin < end && is_blank(source.text()[begin]))
    ++begin;
  spans.push_back({begin, end});
  spans.push_back({source.line_start(line), end});
  spans.push_back({0, static_cast<std::uint32_t>(source.text().size())});
  std::stable_sort(spans.begin(), spans.end(), [](Span a, Span b) { return a.size() < b.size(); });
  std::vector<Span> chain;
  for (const auto span : spans) {
    const bool fits = touches(span, offset) &&
                      (chain.empty() || (span.begin <= chain.back().begin &&
                                         chain.back().end <= span.end && span != chain.back()));
    if (fits)
      chain.push_back(span);
  }
  return chain;
}

void SignatureText::add(std::string_view between, std::string_view name, std::string text) {
  made_.label += between;
  const auto begin = static_cast<std::uint32_t>(made_.label.size());
  made_.label += name;
  made_.parameters.push_back(
      {{begin, static_cast<std::uint32_t>(made_.label.size())}, std::move(text)});
}

Signature SignatureText::take(std::size_t active, std::string markdown) {
  made_.active = active;
  made_.markdown = std::move(markdown);
  return std::move(made_);
}

std::optional<Signature> statement_signature(const spec::StatementInfo& row, std::size_t commas,
                                             std::string_view language) {
  if (row.usage == row.word)
    return std::nullopt;
  // `input` takes a variable before its parameters: commas count only if all are numbers.
  const bool counts = row.form == spec::Form::Arguments && !row.parameters().empty();
  SignatureText text(counts ? row.word : row.usage);
  if (counts)
    for (const auto& parameter : row.parameters())
      text.add(&parameter == row.parameters().data() ? " " : ", ", parameter.name,
               fmt::format("{} to {}{}{}", parameter.least, parameter.greatest,
                           parameter.unit.empty() ? "" : " ", parameter.unit));
  auto markdown = find_markdown(reference::statements_section(), row.word, language);
  return text.take(commas, markdown.value_or(""));
}

std::vector<Lens> run_lenses(const Source& source) {
  const Span first{0, static_cast<std::uint32_t>(source.line(1).size())};
  if (source.text().find_first_not_of(" \t\r\n") == std::string_view::npos)
    return {};
  return {{first, Lens::Deed::Run, ""}, {first, Lens::Deed::Debug, ""}};
}

std::optional<Hint> number_hint(std::string_view parameter, std::string_view unit,
                                std::int64_t value, std::uint32_t at) {
  if (unit == "ms" && value >= second_ms)
    return Hint{at, fmt::format("{} s", static_cast<double>(value) / second_ms),
                fmt::format("{} ms", value)};
  if (parameter == "heading")
    return Hint{at, std::string(arrow(value)), fmt::format("{} degrees clockwise", value)};
  return std::nullopt;
}

} // namespace orb::editor
