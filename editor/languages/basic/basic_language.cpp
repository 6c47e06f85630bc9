// Editor support for orbBasic programs.

#include "base/silence.h"
#include "base/text/text.h"
#include "compiler/check.h"
#include "compiler/renumber.h"
#include "compiler/text/basic_words.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/print.h"
#include "compiler/text/rules.h"
#include "editor/language.h"
#include "editor/languages/basic/basic_completion.h"
#include "editor/languages/basic/basic_names.h"
#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "editor/word_at.h"
#include "reference/sections.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <variant>

namespace orb::editor {
namespace {

using compiler::Program;

const Token* token_at(const std::vector<Token>& tokens, std::uint32_t offset) {
  for (const auto& token : tokens)
    if (token.span.begin <= offset && offset < token.span.end)
      return &token;
  for (const auto& token : tokens) // the end of a word still counts as the word
    if (token.span.end == offset)
      return &token;
  return nullptr;
}

// ---- names: line numbers and variables

/// The name at `offset`; at the border of two names, the second one.
template <typename Name>
const Name* name_at(const std::vector<Name>& names, std::uint32_t offset) {
  const Name* found = nullptr;
  for (const auto& name : names)
    if (touches(name.span, offset) && (found == nullptr || name.span.begin > found->span.begin))
      found = &name;
  return found;
}

const compiler::Line* find_line(const Program& program, std::uint32_t number) {
  for (const auto& line : program.lines)
    if (line.has_number() && line.number == number)
      return &line;
  return nullptr;
}

Occurrences occurrences(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto program = compiler::parse(source.text());
  Occurrences found;
  const auto lines = line_names(program);
  if (const auto* here = name_at(lines, offset)) {
    for (const auto& name : lines)
      if (name.number == here->number)
        (name.is_target ? found.uses : found.definitions).push_back(name.span);
    return found;
  }
  const auto letters = letter_names(program);
  if (const auto* here = name_at(letters, offset))
    for (const auto& name : letters)
      if (name.letter == here->letter)
        (name.is_set ? found.definitions : found.uses).push_back(name.span);
  return found;
}

// ---- hover

/// The errors with which a statement can end a program.
std::vector<spec::BasicError> errors_of(const spec::StatementInfo& row) {
  using spec::BasicError;
  std::vector<BasicError> errors;
  switch (row.form) {
  case spec::Form::Loop: errors = {BasicError::ForDepthExceeded, BasicError::BadStepValue}; break;
  case spec::Form::LoopEnd: errors = {BasicError::NextWithoutFor}; break;
  case spec::Form::Branch: errors = {BasicError::BadLineNumber}; break;
  case spec::Form::IndexedBranch:
    errors = {BasicError::IllegalIndex, BasicError::BadLineNumber};
    break;
  case spec::Form::Variables: errors = {BasicError::OutOfData}; break;
  case spec::Form::Assignment:
  case spec::Form::Conditional:
  case spec::Form::Output:
  case spec::Form::Entry:
  case spec::Form::Values:
  case spec::Form::Arguments: break;
  }
  if (row.statement == spec::Statement::Gosub || row.statement == spec::Statement::On)
    errors.push_back(BasicError::GosubDepthExceeded);
  if (row.statement == spec::Statement::Return)
    errors.push_back(BasicError::ReturnWithoutGosub);
  if (!row.parameters().empty())
    errors.push_back(BasicError::BadNumericParameter);
  return errors;
}

/// The entry of `section` for `word`, with the errors that can end a program there.
std::optional<std::string> markdown_with_errors(const reference::Section& section,
                                                std::string_view word,
                                                const std::vector<spec::BasicError>& errors) {
  for (auto entry : section.entries) {
    if (entry.name != word)
      continue;
    for (const auto error : errors)
      entry.facts.emplace_back(
          "can stop with", fmt::format("{:02X}h {}", spec::code(error), spec::info(error).text));
    return entry_markdown(section, entry, basic_language_id);
  }
  return std::nullopt;
}

std::optional<std::string> word_markdown(std::string_view word) {
  if (const auto statement = spec::find_statement(word))
    return markdown_with_errors(reference::statements_section(), word,
                                errors_of(spec::info(*statement)));
  if (const auto function = spec::find_function(word)) {
    std::vector<spec::BasicError> errors;
    if (function != spec::Function::Abs)
      errors.push_back(spec::BasicError::BadNumericParameter);
    return markdown_with_errors(reference::functions_section(), word, errors);
  }
  if (spec::find_variable(word))
    return find_markdown(reference::variables_section(), word, basic_language_id);
  return std::nullopt;
}

enum class Use : std::uint8_t { Set, Read };
std::string in_lines(const Source& source, const Program& program,
                     const std::vector<LetterName>& names, std::uint8_t letter, Use use) {
  std::vector<std::uint32_t> numbers;
  for (const auto& name : names) {
    if (name.letter != letter || name.is_set != (use == Use::Set))
      continue;
    const auto& line = program.lines[std::min<std::size_t>(
        source.position(name.span.begin).line - 1, program.lines.size() - 1)];
    if (line.has_number() && (numbers.empty() || numbers.back() != line.number))
      numbers.push_back(line.number);
  }
  return numbers.empty() ? "nowhere" : fmt::format("in {}", fmt::join(numbers, ", "));
}

std::string letter_markdown(const Source& source, const Program& program,
                            const std::vector<LetterName>& names, std::uint8_t letter) {
  const auto set = in_lines(source, program, names, letter, Use::Set);
  const auto read = in_lines(source, program, names, letter, Use::Read);
  const auto what =
      letter == indexed_letter
          ? std::string(
                "**`Z`** (variable): the element of the indexed set that `Y` names, 1 to 25")
          : fmt::format("**`{}`** (variable): a 32-bit integer, 0 when the program begins",
                        spec::letter_name(letter));
  return fmt::format("{}\n\n- set: {}\n- read: {}\n", what, set, read);
}

std::string line_markdown(const Program& program, std::uint32_t number) {
  const auto* line = find_line(program, number);
  if (line != nullptr)
    return fmt::format("```{}\n{}\n```\n", basic_language_id, program.text_of(line->span));
  const auto error = spec::BasicError::BadLineNumber;
  return fmt::format("there is no line {}; going there stops the program with {:02X}h {}\n", number,
                     spec::code(error), spec::info(error).text);
}

/// Describes the rule at `offset` in a comment `' orb: allow RULE`.
std::optional<Hover> hover_rule(const Source& source, Span comment, std::uint32_t offset) {
  const auto text = source.text(comment);
  if (text.find(allow_mark) == std::string_view::npos)
    return std::nullopt;
  auto begin = offset - comment.begin;
  auto end = begin;
  while (begin > 0 && is_rule_part(text[begin - 1]))
    --begin;
  while (end < text.size() && is_rule_part(text[end]))
    ++end;
  const auto* rule = compiler::rules::find(text.substr(begin, end - begin));
  if (rule == nullptr)
    return std::nullopt;
  return Hover{{comment.begin + begin, comment.begin + end},
               fmt::format("**`{}`** ({}): {}\n\n{}\n", rule->id, to_string(rule->severity),
                           rule->summary, rule->explanation)};
}

std::optional<Hover> hover(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto tokens = tokens_at(source, offset, basic_lexis);
  const auto* token = token_at(tokens, offset);
  if (token == nullptr)
    return std::nullopt;
  const auto text = source.text(token->span);
  switch (token->kind) {
  case TokenKind::String: return std::nullopt;
  case TokenKind::Comment: return hover_rule(source, token->span, offset);
  case TokenKind::Sign: {
    const auto word = text == "?" ? std::string_view("print") : text;
    if (auto found = word_markdown(word))
      return Hover{token->span, *found};
    if (auto found = find_markdown(reference::operators_section(), word, basic_language_id))
      return Hover{token->span, *found};
    return std::nullopt;
  }
  case TokenKind::Word:
    if (auto found = word_markdown(text))
      return Hover{token->span, *found};
    if (text.size() == 1) {
      const auto program = compiler::parse(source.text());
      const auto letter = compiler::find_word(text).index;
      return Hover{token->span, letter_markdown(source, program, letter_names(program), letter)};
    }
    return std::nullopt;
  case TokenKind::Number: {
    const auto program = compiler::parse(source.text());
    const auto names = line_names(program);
    const auto* name = name_at(names, offset);
    if (name == nullptr)
      return std::nullopt;
    if (name->is_target)
      return Hover{name->span, line_markdown(program, name->number)};
    const auto jumps = std::count_if(names.begin(), names.end(), [&](const LineName& one) {
      return one.is_target && one.number == name->number;
    });
    return Hover{name->span, fmt::format("line {}: {} jump{} here\n", name->number, jumps,
                                         jumps == 1 ? " leads" : "s lead")};
  }
  }
  return std::nullopt;
}

// ---- outline

std::vector<Symbol> outline(const Source& source) {
  const auto program = compiler::parse(source.text());
  std::vector<Symbol> symbols;
  for (const auto& part : parts_of(program)) {
    const auto& first = program.lines[part.first];
    symbols.push_back(
        {part.title,
         std::string(part.is_called ? "subroutine" : "jump target"),
         {first.span.begin, std::max(program.lines[part.last].span.end, first.span.end)},
         first.number_span});
  }
  return symbols;
}

// ---- changes

tl::expected<std::vector<Edit>, std::string>
rename_letter(const std::vector<LetterName>& names, std::uint8_t letter, std::string_view name) {
  if (letter == indexed_letter)
    return tl::unexpected(
        std::string("`Z` names an element of the indexed set; it cannot be renamed"));
  if (name.size() != 1 || !is_letter(name.front()) || (name.front() & ~0x20) == 'Z')
    return tl::unexpected(std::string("a variable is one letter from `A` to `Y`"));
  const auto wanted = compiler::find_word(name).index;
  std::vector<Edit> edits;
  for (const auto& one : names) {
    if (one.letter == wanted && wanted != letter)
      return tl::unexpected(fmt::format("`{}` is already in use", name));
    if (one.letter == letter)
      edits.push_back({one.span, std::string(name)});
  }
  return edits;
}

tl::expected<std::vector<Edit>, std::string> rename_line(const Program& program,
                                                         const std::vector<LineName>& names,
                                                         const LineName& here,
                                                         std::string_view name) {
  const auto number = parse_number<std::uint32_t>(name).value_or(0);
  if (number < 1 || number > most_line_number)
    return tl::unexpected(fmt::format("a line number must be 1 to {}", most_line_number));
  if (number != here.number && find_line(program, number) != nullptr)
    return tl::unexpected(fmt::format("line {} already exists", number));
  const auto* first = find_line(program, here.number);
  if (first == nullptr)
    return tl::unexpected(fmt::format("there is no line {}", here.number));
  const auto text = fmt::format("{}", number);
  // No jump reaches a later line with the same number, so only that line is renumbered.
  if (!here.is_target && here.span != first->number_span)
    return std::vector<Edit>{{here.span, text}};
  std::vector<Edit> edits;
  for (const auto& one : names)
    if (one.number == here.number && (one.is_target || one.span == first->number_span))
      edits.push_back({one.span, text});
  std::sort(edits.begin(), edits.end(),
            [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
  return edits;
}

tl::expected<std::vector<Edit>, std::string>
edits_of_renaming(const Source& source, std::uint32_t offset, std::string_view name) {
  const auto program = compiler::parse(source.text());
  const auto lines = line_names(program);
  if (const auto* here = name_at(lines, offset))
    return rename_line(program, lines, *here, name);
  const auto letters = letter_names(program);
  if (const auto* here = name_at(letters, offset))
    return rename_letter(letters, here->letter, name);
  return tl::unexpected(std::string("this is neither a line number nor a variable"));
}

tl::expected<Renaming, std::string> rename(const Source& source, std::uint32_t offset,
                                           std::string_view name, const LanguageOptions&) {
  auto edits = edits_of_renaming(source, offset, name);
  if (!edits)
    return tl::unexpected(std::move(edits.error()));
  return Renaming{*std::move(edits), {}};
}

compiler::Target target_of(const LanguageOptions& options) {
  compiler::Target target;
  target.version = options.target;
  return target;
}

std::vector<Diagnostic> check(const Source& source, const LanguageOptions& options) {
  return compiler::check(source.text(), target_of(options)).diagnostics;
}

std::optional<std::string> format(const Source& source) {
  return compiler::format(compiler::parse(source.text()));
}

std::vector<Rewrite> rewrites(const Source& source, const LanguageOptions& options) {
  std::vector<Rewrite> all;
  auto fixed = compiler::fix(std::string(source.text()), target_of(options));
  if (fixed.count > 0)
    all.push_back({"apply all safe fixes", "source.fixAll", std::move(fixed.text)});
  const auto program = compiler::parse(source.text());
  if (auto numbered = compiler::renumber(program, {});
      const auto* text = std::get_if<std::string>(&numbered))
    if (*text != source.text())
      all.push_back({"renumber the lines 10, 20, 30 and so on", "source.renumber", *text});
  return all;
}

// ---- hints

std::vector<Hint> hints(const Source& source, const LanguageOptions&) {
  const auto program = compiler::parse(source.text());
  std::vector<Hint> found;
  for (const auto& node : program.statements) {
    if (node.error)
      continue;
    const auto parameters = spec::info(node.kind).parameters();
    auto parameter = parameters.begin();
    for (const auto& item : program.items_of(node)) {
      if (item.kind != compiler::ItemKind::Expression || parameter == parameters.end())
        continue;
      const auto& root = program.nodes[item.value];
      if (root.kind == compiler::NodeKind::Number)
        if (auto hint = number_hint(parameter->name, parameter->unit, root.value, item.span.end))
          found.push_back(*std::move(hint));
      ++parameter;
    }
  }
  std::sort(found.begin(), found.end(), [](const Hint& a, const Hint& b) { return a.at < b.at; });
  return found;
}

} // namespace

const LanguageService basic_service = {check,  hover,  suggest_basic, outline,      occurrences,
                                       rename, format, rewrites,      &basic_shape, hints};

} // namespace orb::editor
