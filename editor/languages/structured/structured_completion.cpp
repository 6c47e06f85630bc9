#include "editor/languages/structured/structured_completion.h"

#include "base/silence.h"
#include "base/text/text.h"
#include "compiler/text/rules.h"
#include "editor/languages/markdown.h"
#include "editor/languages/structured/structured_names.h"
#include "editor/word_at.h"
#include "reference/sections.h"
#include "structured/text/link_blocks.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>

namespace orb::editor {
namespace {

using structured::Kind;
using structured::SymbolKind;

enum class Context : std::uint8_t { Statement, Expression, Colour, Label, Block, Macro };

Context context_after(const Source& source, const std::vector<Token>& before) {
  if (before.empty())
    return Context::Statement;
  const auto word = structured::find_word(source.text(before.back().span));
  if (word.is(structured::Keyword::Then) || word.is(structured::Keyword::Else))
    return Context::Statement;
  if (word.is(spec::Statement::Goto))
    return Context::Label;
  if (word.is(spec::Statement::Macrun))
    return Context::Macro;
  if (word.is(spec::Statement::Rgb))
    return Context::Colour;
  return before.size() == 1 && word.is(spec::Statement::End) ? Context::Block : Context::Expression;
}

class Suggester {
public:
  Suggester(const Source& source, std::uint32_t offset, const LanguageOptions& options,
            Suggestions& out)
      : reading_(read_structured(source, options)), offset_(offset), out_(out) {}

  void suggest(Context context) {
    switch (context) {
    case Context::Statement:
      names({SymbolKind::Variable, SymbolKind::Local, SymbolKind::Parameter, SymbolKind::Array,
             SymbolKind::Sub});
      statements();
      words(reference::structured_words_section());
      settable();
      return;
    case Context::Colour:
      for (const auto name : structured::colour_names())
        out_.items.push_back({std::string(name), SuggestionKind::Value, "colour", ""});
      suggest(Context::Expression);
      return;
    case Context::Expression:
      names({SymbolKind::Variable, SymbolKind::Local, SymbolKind::Parameter, SymbolKind::Array,
             SymbolKind::Constant, SymbolKind::Function});
      rows(reference::variables_section(), SuggestionKind::Variable);
      rows(reference::functions_section(), SuggestionKind::Function);
      words(reference::structured_words_section());
      return;
    case Context::Label: labels(); return;
    case Context::Block:
      for (const auto word : structured::words_after_end())
        out_.items.push_back(
            {std::string(word), SuggestionKind::Keyword, fmt::format("end {}", word), ""});
      return;
    case Context::Macro: names({SymbolKind::Constant}); return;
    }
  }

private:
  std::uint32_t routine() const {
    std::uint32_t routine = 0;
    const auto& statements = reading_.program.statements;
    for (std::uint32_t i = 0; i < statements.size() && statements[i].span.begin < offset_; ++i) {
      const bool ended =
          statements[i].kind == Kind::EndSub || statements[i].kind == Kind::EndFunction;
      routine = ended ? 0 : reading_.names.routine_of[i];
    }
    return routine;
  }

  void names(std::initializer_list<SymbolKind> kinds) {
    const auto here = routine();
    for (const auto kind : kinds)
      for (const auto& symbol : reading_.names.symbols) {
        const bool own = symbol.kind == SymbolKind::Local || symbol.kind == SymbolKind::Parameter;
        if (symbol.kind != kind || (own && symbol.routine != here) ||
            (symbol.span.begin <= offset_ && offset_ <= symbol.span.end))
          continue;
        const bool calls = kind == SymbolKind::Sub || kind == SymbolKind::Function;
        out_.items.push_back({std::string(reading_.program.name(symbol.name)),
                              calls                          ? SuggestionKind::Function
                              : kind == SymbolKind::Constant ? SuggestionKind::Value
                                                             : SuggestionKind::Variable,
                              detail_of(symbol), ""});
      }
  }

  std::string detail_of(const structured::Symbol& symbol) const {
    switch (symbol.kind) {
    case SymbolKind::Variable: return "variable";
    case SymbolKind::Local: return "local variable";
    case SymbolKind::Parameter: return "parameter";
    case SymbolKind::Constant: return fmt::format("{}", symbol.value);
    case SymbolKind::Array: return fmt::format("array of {}", symbol.value);
    case SymbolKind::Sub:
    case SymbolKind::Function: {
      const auto& statement = reading_.program.statements[symbol.statement];
      return std::string(trim(reading_.program.text_of(statement.span)));
    }
    }
    return {};
  }

  void statements() {
    const auto section = reference::statements_section();
    for (std::size_t i = 0; i < spec::statements.size(); ++i) {
      const auto word = structured::find_word(spec::statements[i].word);
      const bool is_numbered = spec::statements[i].statement == spec::Statement::Gosub ||
                               spec::statements[i].statement == spec::Statement::On;
      if (word.kind == structured::WordKind::Statement && !is_numbered)
        out_.items.push_back({std::string(spec::statements[i].word), SuggestionKind::Keyword,
                              std::string(spec::statements[i].usage),
                              entry_markdown(section, section.entries[i], structured_language_id)});
    }
  }

  void rows(const reference::Section& section, SuggestionKind kind) {
    for (const auto& entry : section.entries)
      out_.items.push_back({entry.name, kind, entry.summary,
                            entry_markdown(section, entry, structured_language_id)});
  }

  void words(const reference::Section& section) {
    for (const auto& entry : section.entries) {
      const bool listed =
          std::any_of(out_.items.begin(), out_.items.end(),
                      [&](const Suggestion& item) { return item.label == entry.name; });
      if (!listed)
        out_.items.push_back({entry.name, SuggestionKind::Keyword, entry.summary,
                              entry_markdown(section, entry, structured_language_id)});
    }
  }

  void settable() {
    for (const auto& row : spec::variables)
      if (row.access == spec::Access::ReadWrite)
        out_.items.push_back(
            {std::string(row.word), SuggestionKind::Variable, std::string(row.summary), ""});
  }

  void labels() {
    const auto here = routine();
    const auto& program = reading_.program;
    for (std::uint32_t i = 0; i < program.statements.size(); ++i)
      if (program.statements[i].kind == Kind::Label && reading_.names.routine_of[i] == here)
        out_.items.push_back({std::string(program.name(program.statements[i].name)),
                              SuggestionKind::Line, "label", ""});
  }

  Reading reading_;
  std::uint32_t offset_;
  Suggestions& out_;
};

void suggest_rules(const Source& source, Span comment, Suggestions& out) {
  const auto text = source.text();
  if (source.text({comment.begin, out.replaces.end}).find(allow_mark) == std::string_view::npos)
    return;
  while (out.replaces.begin > comment.begin && is_rule_part(text[out.replaces.begin - 1]))
    --out.replaces.begin;
  for (const auto rules : {structured::rules::all(), compiler::rules::all()})
    for (const auto& rule : rules)
      out.items.push_back({std::string(rule.id), SuggestionKind::Rule, std::string(rule.summary),
                           std::string(rule.explanation)});
}

} // namespace

Suggestions suggest_structured(const Source& source, std::uint32_t offset,
                               const LanguageOptions& options) {
  offset = std::min(offset, static_cast<std::uint32_t>(source.text().size()));
  Suggestions out{{offset, offset}, {}};
  std::vector<Token> before;
  for (const auto& token : tokens_at(source, offset, structured_lexis)) {
    if (token.span.begin >= offset)
      break;
    if (token.kind == TokenKind::Comment) {
      suggest_rules(source, token.span, out);
      return out;
    }
    if (token.kind == TokenKind::String && offset < token.span.end)
      return out;
    if (token.kind == TokenKind::Word && offset <= token.span.end) {
      out.replaces.begin = token.span.begin;
      break;
    }
    before.push_back(token);
  }
  Suggester(source, offset, options, out).suggest(context_after(source, before));
  return out;
}

} // namespace orb::editor
