#include "editor/languages/basic/basic_completion.h"

#include "base/silence.h"
#include "base/text/text.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/rules.h"
#include "editor/languages/basic/basic_names.h"
#include "editor/languages/markdown.h"
#include "editor/word_at.h"
#include "reference/sections.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

using compiler::Program;

/// The position of the cursor in a line, derived from the words before it.
enum class Context : std::uint8_t { LineNumber, Statement, BranchStatement, Target, Expression };

Context context_before(const Source& source, const std::vector<Token>& before) {
  if (before.empty())
    return Context::LineNumber;
  if (before.size() == 1 && before.front().kind == TokenKind::Number)
    return Context::Statement;
  const auto& last = before.back();
  if (last.kind == TokenKind::Word) {
    const auto word = source.text(last.span);
    if (word == "then" || word == "else")
      return Context::BranchStatement;
    if (word == "goto" || word == "gosub")
      return Context::Target;
  }
  // `on A goto 10,20,` expects a target, too.
  for (auto token = before.rbegin(); token != before.rend(); ++token) {
    const auto text = source.text(token->span);
    if (token->kind == TokenKind::Word)
      return (text == "goto" || text == "gosub") && source.text(last.span) == ","
                 ? Context::Target
                 : Context::Expression;
    if (token->kind != TokenKind::Number && text != ",")
      break;
  }
  return Context::Expression;
}

void suggest_statements(Suggestions& out, Context context) {
  const auto section = reference::statements_section();
  for (std::size_t i = 0; i < spec::statements.size(); ++i) {
    const auto& row = spec::statements[i];
    if (context == Context::BranchStatement && row.in_then == spec::InThen::Refused)
      continue;
    out.items.push_back({std::string(row.word), SuggestionKind::Keyword,
                         fmt::format("{} (since {})", row.usage, spec::info(row.since).text),
                         entry_markdown(section, section.entries[i], basic_language_id)});
  }
  const auto variables = reference::variables_section();
  for (std::size_t i = 0; i < spec::variables.size(); ++i)
    if (spec::variables[i].access == spec::Access::ReadWrite)
      out.items.push_back({std::string(spec::variables[i].word), SuggestionKind::Variable,
                           std::string(spec::variables[i].summary),
                           entry_markdown(variables, variables.entries[i], basic_language_id)});
}

void suggest_expression(Suggestions& out) {
  const auto variables = reference::variables_section();
  for (std::size_t i = 0; i < spec::variables.size(); ++i) {
    const auto& row = spec::variables[i];
    out.items.push_back({std::string(row.word), SuggestionKind::Variable,
                         fmt::format("{} to {}{}{}", row.least, row.greatest,
                                     row.unit.empty() ? "" : " ", row.unit),
                         entry_markdown(variables, variables.entries[i], basic_language_id)});
  }
  const auto functions = reference::functions_section();
  for (std::size_t i = 0; i < spec::functions.size(); ++i)
    out.items.push_back({std::string(spec::functions[i].word), SuggestionKind::Function,
                         std::string(spec::functions[i].summary),
                         entry_markdown(functions, functions.entries[i], basic_language_id)});
  for (const auto word : spec::particles)
    out.items.push_back({std::string(word), SuggestionKind::Keyword, "", ""});
  for (const auto statement : {spec::Statement::Goto, spec::Statement::Gosub}) // after `on e`
    out.items.push_back({std::string(spec::info(statement).word), SuggestionKind::Keyword,
                         std::string(spec::info(statement).usage), ""});
}

void suggest_targets(Suggestions& out, const Program& program) {
  for (const auto& line : program.lines)
    if (line.has_number() && line.has_statement())
      out.items.push_back({fmt::format("{}", line.number), SuggestionKind::Line,
                           std::string(program.text_of(line.span)), ""});
}

/// Suggests a number for a new line: the previous one plus ten, or halfway to the next one if that
/// is too large.
void suggest_line_number(Suggestions& out, const Program& program, std::uint32_t offset) {
  constexpr std::uint32_t step = 10;
  std::uint32_t before = 0;
  std::uint32_t after = most_line_number + 1;
  for (const auto& line : program.lines) {
    if (!line.has_number() || touches(line.span, offset))
      continue;
    if (line.span.begin < offset)
      before = line.number;
    else
      after = std::min(after, line.number);
  }
  if (before + 1 >= after)
    return;
  const auto number = before + step < after ? before + step : before + (after - before) / 2;
  if (number >= 1 && number <= most_line_number)
    out.items.push_back({fmt::format("{}", number), SuggestionKind::Line, "a new line here", ""});
}

void suggest_rules(Suggestions& out) {
  for (const auto& rule : compiler::rules::all())
    out.items.push_back({std::string(rule.id), SuggestionKind::Rule, std::string(rule.summary),
                         std::string(rule.explanation)});
}

} // namespace

Suggestions suggest_basic(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto text = source.text();
  offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  Suggestions out{{offset, offset}, {}};
  std::vector<Token> before;
  for (const auto& token : tokens_at(source, offset, basic_lexis)) {
    const bool open_end = token.kind == TokenKind::Comment ||
                          (token.kind == TokenKind::String && is_open(source, token));
    const bool inside = token.span.begin < offset &&
                        (open_end ? offset <= token.span.end : offset < token.span.end);
    if (token.kind == TokenKind::Comment && inside) {
      const auto typed = source.text({token.span.begin, offset});
      if (typed.find(allow_mark) == std::string_view::npos)
        return out;
      while (out.replaces.begin > token.span.begin && is_rule_part(text[out.replaces.begin - 1]))
        --out.replaces.begin;
      suggest_rules(out);
      return out;
    }
    if (token.kind == TokenKind::String && inside)
      return out;
    const bool is_typed = (token.kind == TokenKind::Word || token.kind == TokenKind::Number) &&
                          token.span.begin < offset && offset <= token.span.end;
    // The number at the start of the line stays; a number elsewhere is being typed.
    if (is_typed) {
      out.replaces = {token.span.begin, offset};
      break;
    }
    if (token.span.begin >= offset)
      break;
    before.push_back(token);
  }
  switch (context_before(source, before)) {
  case Context::LineNumber: suggest_line_number(out, compiler::parse(text), offset); break;
  case Context::Statement: suggest_statements(out, Context::Statement); break;
  case Context::BranchStatement: suggest_statements(out, Context::BranchStatement); break;
  case Context::Target: suggest_targets(out, compiler::parse(text)); break;
  case Context::Expression: suggest_expression(out); break;
  }
  return out;
}

} // namespace orb::editor
