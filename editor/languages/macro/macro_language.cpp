// Editor support for macro source.

#include "assembler/assemble.h"
#include "assembler/lint/lint.h"
#include "assembler/text/layout.h"
#include "assembler/text/parse_macro.h"
#include "base/text/text.h"
#include "editor/directives.h"
#include "editor/language.h"
#include "editor/languages/macro/macro_names.h"
#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "editor/word_at.h"
#include "reference/sections.h"
#include "spec/macro.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

using assembler::Program;
using assembler::Statement;
using assembler::Value;

bool is_word_part(char c) {
  return is_letter(c) || is_digit(c) || c == '_';
}

// ---- names: macros and constants

const MacroName* name_at(const std::vector<MacroName>& names, std::uint32_t offset) {
  for (const auto& name : names)
    if (touches(name.span, offset))
      return &name;
  return nullptr;
}

/// The value at `offset`, with its statement.
struct ValueSpot {
  const Statement* statement = nullptr;
  std::uint32_t index = 0;
};

std::optional<ValueSpot> value_at(const Program& program, std::uint32_t offset) {
  for (const auto& statement : program.statements)
    for (std::uint32_t i = 0; i < statement.count; ++i)
      if (touches(program.values_of(statement)[i].span, offset))
        return ValueSpot{&statement, i};
  return std::nullopt;
}

/// The name of the macro whose id is at `offset`, if that is a target.
std::optional<Span> macro_of_id(const Source& source, const Program& program,
                                std::uint32_t offset) {
  const auto spot = value_at(program, offset);
  if (!spot)
    return std::nullopt;
  const auto* operand = operand_of(source, program, *spot->statement, spot->index);
  const auto& value = program.values_of(*spot->statement)[spot->index];
  if (operand == nullptr || operand->kind != spec::MacroOperandKind::MacroId ||
      value.kind != Value::Kind::Number)
    return std::nullopt;
  for (const auto& macro : assembler::assemble(source).macros)
    if (macro.id && !macro.name.empty() && *macro.id * 1000 == value.thousandths)
      return macro.span;
  return std::nullopt;
}

Occurrences occurrences(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto program = assembler::parse(source.text());
  const auto names = names_in(source, program);
  Occurrences found;
  if (const auto* here = name_at(names, offset)) {
    for (const auto& name : names)
      if (source.text(name.span) == source.text(here->span))
        (name.is_definition ? found.definitions : found.uses).push_back(name.span);
  } else if (const auto macro = macro_of_id(source, program, offset)) {
    found.definitions.push_back(*macro);
  }
  return found;
}

bool is_name(std::string_view text) {
  return !text.empty() && !is_digit(text.front()) &&
         std::all_of(text.begin(), text.end(), is_word_part);
}

tl::expected<Renaming, std::string> rename(const Source& source, std::uint32_t offset,
                                           std::string_view name, const LanguageOptions&) {
  const auto program = assembler::parse(source.text());
  const auto names = names_in(source, program);
  const auto* here = name_at(names, offset);
  if (here == nullptr)
    return tl::unexpected(std::string("there is no macro or constant name here"));
  if (!is_name(name))
    return tl::unexpected(
        std::string("a name is letters, digits and `_`, and does not begin with a digit"));
  const auto old = source.text(here->span);
  std::vector<Edit> edits;
  bool defined = false;
  for (const auto& one : names) {
    const auto text = source.text(one.span);
    if (text == name && text != old)
      return tl::unexpected(fmt::format("`{}` is already in use", name));
    if (text != old)
      continue;
    defined = defined || one.is_definition;
    edits.push_back({one.span, std::string(name)});
  }
  if (!defined)
    return tl::unexpected(fmt::format("`{}` is not defined in this file", old));
  return Renaming{std::move(edits), {}};
}

// ---- hover

const MacroDirective* find_directive(std::string_view word) {
  for (const auto& row : macro_directives)
    if (word == row.word)
      return &row;
  return nullptr;
}

std::string_view line_text(const Source& source, std::uint32_t offset) {
  return source.line(source.position(offset).line);
}

std::optional<Hover> hover(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto program = assembler::parse(source.text());
  for (const auto& statement : program.statements) {
    if (!touches(statement.head, offset))
      continue;
    const auto head = source.text(statement.head);
    if (const auto text =
            find_markdown(reference::macro_commands_section(), head, macro_language_id))
      return Hover{statement.head, *text};
    const auto* directive = head.starts_with(".") ? find_directive(head.substr(1)) : nullptr;
    if (directive == nullptr)
      return std::nullopt;
    return Hover{statement.head, fmt::format("**`{}`** (directive): {}\n\n- usage: `{}`\n", head,
                                             directive->summary, directive->usage)};
  }
  const auto names = names_in(source, program);
  if (const auto* here = name_at(names, offset)) {
    for (const auto& name : names)
      if (name.is_definition && source.text(name.span) == source.text(here->span))
        return Hover{here->span, fmt::format("```{}\n{}\n```\n", macro_language_id,
                                             line_text(source, name.span.begin))};
    return std::nullopt;
  }
  const auto spot = value_at(program, offset);
  if (!spot)
    return std::nullopt;
  const auto& value = program.values_of(*spot->statement)[spot->index];
  if (const auto* operand = operand_of(source, program, *spot->statement, spot->index))
    return Hover{value.span, fmt::format("**`{}`** (operand of `{}`): {}\n", operand->name,
                                         source.text(spot->statement->head), range_text(*operand))};
  if (const auto text = find_markdown(reference::macro_flags_section(), source.text(value.span),
                                      macro_language_id))
    return Hover{value.span, *text};
  return std::nullopt;
}

// ---- completion

void suggest_heads(Suggestions& out) {
  const auto section = reference::macro_commands_section();
  for (std::size_t i = 0; i < std::size(spec::macro_commands); ++i) {
    const auto& row = spec::macro_commands[i];
    std::string operands;
    for (const auto& operand : row)
      operands += fmt::format("{}{}", operands.empty() ? "" : ", ", operand.name);
    out.items.push_back({std::string(row.mnemonic), SuggestionKind::Keyword, operands,
                         entry_markdown(section, section.entries[i], macro_language_id)});
  }
  for (const auto& row : macro_directives)
    out.items.push_back({fmt::format(".{}", row.word), SuggestionKind::Keyword,
                         std::string(row.usage), std::string(row.summary)});
}

void suggest_flags(Suggestions& out) {
  for (const auto& row : spec::macro_flags)
    out.items.push_back(
        {std::string(row.word), SuggestionKind::Value, std::string(row.summary), ""});
}

void suggest_attributes(Suggestions& out) {
  out.items.push_back({"id=", SuggestionKind::Value,
                       fmt::format("{} to {} for a user macro", spec::macro_id_user_first,
                                   spec::macro_id_user_last),
                       ""});
  out.items.push_back({"flags=", SuggestionKind::Value, "separated by commas", ""});
  out.items.push_back({"ext=", SuggestionKind::Value, "extended flags, 0 to 255", ""});
}

/// Suggests values of `operand`: its own words, constants, and macros if it takes one.
void suggest_values(Suggestions& out, const Source& source, const Program& program,
                    const spec::MacroOperand& operand) {
  for (const auto* word = operand.begin_words(); word != operand.end_words(); ++word)
    out.items.push_back({std::string(word->word), SuggestionKind::Value,
                         fmt::format("{} is {}", operand.name, word->value), ""});
  const bool wants_macro = operand.kind == spec::MacroOperandKind::MacroId;
  for (const auto& statement : program.statements) {
    if (statement.count == 0)
      continue;
    const auto& value = program.values_of(statement).front();
    const auto line = std::string(line_text(source, value.span.begin));
    if (statement.kind == Statement::Kind::Macro && wants_macro && value.name.size() == 0)
      out.items.push_back({std::string(source.text(value.span)), SuggestionKind::Name, line, ""});
    if (statement.kind == Statement::Kind::Const && value.name.size() > 0)
      out.items.push_back({std::string(source.text(value.name)), SuggestionKind::Name, line, ""});
  }
}

/// The line up to the word being typed, split into words; `=` and `,` are separate.
struct Before {
  std::vector<std::string_view> words;
  bool in_text = false; ///< inside a text or a comment
};

Before cut(std::string_view line) {
  Before before;
  for (std::size_t at = 0; at < line.size();) {
    const char c = line[at];
    if (c == '#') {
      before.in_text = true;
      return before;
    }
    auto end = at + 1;
    if (c == '"') {
      while (end < line.size() && line[end] != '"')
        end += line[end] == '\\' ? 2 : 1;
      if (end >= line.size()) {
        before.in_text = true;
        return before;
      }
      ++end;
    } else if (is_word_part(c) || c == '.') {
      while (end < line.size() && (is_word_part(line[end]) || line[end] == '.'))
        ++end;
    }
    if (c != ' ' && c != '\t')
      before.words.push_back(line.substr(at, end - at));
    at = end;
  }
  return before;
}

/// The attribute that the next word of a `.macro` line belongs to: `flags` after `flags=a,`.
std::string_view attribute_before(const std::vector<std::string_view>& words) {
  if (words.back() != "=" && words.back() != ",")
    return {};
  for (std::size_t i = words.size(); i-- > 1;)
    if (words[i] == "=")
      return words[i - 1];
  return {};
}

void suggest_operands(Suggestions& out, const Source& source, const Program& program,
                      const spec::MacroCommandInfo& row,
                      const std::vector<std::string_view>& words) {
  if (words.back() == "=") {
    for (const auto& operand : row)
      if (words.size() > 1 && operand.name == words[words.size() - 2])
        suggest_values(out, source, program, operand);
    return;
  }
  // The number of operands so far, and those given by name.
  std::size_t given = 0;
  for (std::size_t i = 1; i < words.size(); ++i)
    if (words[i] != "," && words[i] != "=" && (i < 1 || words[i - 1] != "="))
      ++given;
  if (given < row.operand_count)
    suggest_values(out, source, program, *(row.begin() + given));
  for (const auto& operand : row)
    if (std::find(words.begin() + 1, words.end(), operand.name) == words.end())
      out.items.push_back(
          {fmt::format("{}=", operand.name), SuggestionKind::Value, range_text(operand), ""});
}

Suggestions suggest(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto text = source.text();
  offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  const auto start = source.line_start(source.position(offset).line);
  Suggestions out{{offset, offset}, {}};
  while (out.replaces.begin > start &&
         (is_word_part(text[out.replaces.begin - 1]) || text[out.replaces.begin - 1] == '.'))
    --out.replaces.begin;
  const auto before = cut(source.text({start, out.replaces.begin}));
  if (before.in_text)
    return out;
  if (before.words.empty()) {
    suggest_heads(out);
    return out;
  }
  const auto head = before.words.front();
  if (head == ".macro") {
    const auto attribute = attribute_before(before.words);
    if (attribute == "flags")
      suggest_flags(out);
    else if (attribute.empty() && before.words.size() > 1)
      suggest_attributes(out);
    return out;
  }
  for (const auto& row : spec::macro_commands)
    if (row.mnemonic == head)
      suggest_operands(out, source, assembler::parse(text), row, before.words);
  return out;
}

// ---- the rest

std::vector<Symbol> outline(const Source& source) {
  std::vector<Symbol> symbols;
  const auto end = static_cast<std::uint32_t>(source.text().size());
  for (const auto& macro : assembler::assemble(source).macros) {
    if (macro.name.empty())
      continue;
    const auto start = source.line_start(source.position(macro.span.begin).line);
    if (!symbols.empty())
      symbols.back().span.end = std::max(start, symbols.back().selection.end);
    symbols.push_back({macro.name,
                       macro.id ? fmt::format("macro {}", *macro.id) : "macro",
                       {start, end},
                       macro.span});
  }
  return symbols;
}

std::vector<Diagnostic> check(const Source& source, const LanguageOptions&) {
  return assembler::check(source);
}

std::optional<std::string> format(const Source& source) {
  return assembler::layout(source.text());
}

std::vector<Rewrite> rewrites(const Source&, const LanguageOptions&) {
  return {};
}

std::vector<Hint> hints(const Source& source, const LanguageOptions&) {
  const auto program = assembler::parse(source.text());
  std::vector<Hint> found;
  for (const auto& statement : program.statements)
    for (std::uint32_t i = 0; i < statement.count; ++i) {
      const auto& value = program.values_of(statement)[i];
      const auto* operand = operand_of(source, program, statement, i);
      if (operand == nullptr || value.kind != Value::Kind::Number)
        continue;
      const bool says_itself = value.unit != nullptr || !value.is_known;
      if (auto hint = number_hint(operand->name, says_itself ? "" : spec::to_string(operand->unit),
                                  value.thousandths / assembler::whole, value.span.end))
        found.push_back(*std::move(hint));
    }
  return found;
}

} // namespace

const LanguageService macro_service = {check,  hover,  suggest,  outline,      occurrences,
                                       rename, format, rewrites, &macro_shape, hints};

} // namespace orb::editor
