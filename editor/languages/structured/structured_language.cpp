// Editor support for structured programs.

#include "assembler/assemble.h"
#include "base/fixes.h"
#include "base/text/text.h"
#include "compiler/check.h"
#include "compiler/text/rules.h"
#include "editor/language.h"
#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "editor/languages/structured/hints.h"
#include "editor/languages/structured/structured_completion.h"
#include "editor/languages/structured/structured_names.h"
#include "editor/text_places.h"
#include "editor/word_at.h"
#include "reference/sections.h"
#include "structured/compile.h"
#include "structured/layout/format.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace orb::editor {
namespace {

using structured::Compiled;
using structured::Kind;
using structured::none;
using structured::Program;
using structured::SymbolKind;

// ---- names

/// The name that touches `offset`; at the border of two names, the second one.
const NameUse* use_at(const std::vector<NameUse>& uses, std::uint32_t offset) {
  const NameUse* found = nullptr;
  for (const auto& use : uses)
    if (use.span.begin <= offset && offset <= use.span.end)
      found = &use;
  return found;
}

/// A program that contains a text, and the name in question.
struct Part {
  Reading reading;
  std::vector<NameUse> uses;
  const NameUse* here = nullptr; ///< null if there is no name
  std::uint32_t file = 0;        ///< index of the text among the program's files
};

Part part_of(const Source& root, const std::string& path, std::uint32_t offset,
             const LanguageOptions& options) {
  Part part{read_structured(root, options), {}, nullptr, 0};
  const auto& files = part.reading.program.files;
  while (part.file < files.size() && files[part.file].path != path)
    ++part.file;
  if (part.file == files.size())
    return part;
  part.uses = name_uses(part.reading);
  part.here = use_at(part.uses, files[part.file].begin + offset);
  return part;
}

/// The programs that share the name at `offset`: the text itself, and open ones that include it.
std::vector<Part> parts_with(const Source& source, std::uint32_t offset,
                             const LanguageOptions& options) {
  const auto path = path_of_uri(source.name());
  std::vector<Part> parts;
  const auto add = [&](const Source& root) {
    auto part = part_of(root, path, offset, options);
    if (part.here != nullptr)
      parts.push_back(std::move(part));
  };
  add(source);
  for (const auto* other : options.open)
    if (other->name() != source.name())
      add(*other);
  return parts;
}

void add_once(std::vector<FarPlace>& places, FarPlace place) {
  for (const auto& known : places)
    if (known.source->name() == place.source->name() && known.span == place.span)
      return;
  places.push_back(std::move(place));
}

/// The file of a macro that `use` loads.
std::optional<FarPlace> macro_place(const Part& part) {
  const auto& program = part.reading.program;
  if (part.here->meaning.symbol == none)
    return std::nullopt;
  const auto& symbol = part.reading.names.symbols[part.here->meaning.symbol];
  if (symbol.statement == none || program.statements[symbol.statement].kind != Kind::Use)
    return std::nullopt;
  for (const auto& file : program.macro_files) {
    auto written = std::make_shared<const Source>(file.path, file.text);
    for (const auto& macro : assembler::assemble(*written).macros)
      if (equal_words(macro.name, program.name(symbol.name)))
        return FarPlace{std::move(written), macro.span, true};
  }
  return std::nullopt;
}

Occurrences occurrences(const Source& source, std::uint32_t offset,
                        const LanguageOptions& options) {
  std::vector<FarPlace> places;
  Occurrences found;
  for (const auto& part : parts_with(source, offset, options)) {
    if (auto macro = macro_place(part))
      add_once(places, *std::move(macro));
    for (const auto& use : part.uses) {
      auto place = use.meaning == part.here->meaning ? part.reading.place(use.span) : std::nullopt;
      if (!place)
        continue;
      place->defines = use.defines;
      if (place->source == part.reading.sources[part.file])
        place->source = std::make_shared<const Source>(source);
      add_once(places, *std::move(place));
    }
  }
  for (auto& place : places)
    if (place.source->name() != source.name())
      found.elsewhere.push_back(std::move(place));
    else
      (place.defines ? found.definitions : found.uses).push_back(place.span);
  return found;
}

// ---- hover

/// `in lines 2, 5`; lines of other files carry their name: `in lines 2, lib.orb:5`.
enum class Use : std::uint8_t { Set, Read };
std::string lines_where(const Part& part, Use wanted) {
  std::vector<std::string> lines;
  for (const auto& use : part.uses) {
    if (!(use.meaning == part.here->meaning) || use.is_set != (wanted == Use::Set))
      continue;
    const auto place = part.reading.place(use.span);
    if (!place)
      continue;
    const auto line = place->source->position(place->span.begin).line;
    const bool own = place->source == part.reading.sources[part.file];
    auto words = own ? fmt::format("{}", line)
                     : fmt::format("{}:{}", file_name(place->source->name()), line);
    if (lines.empty() || lines.back() != words)
      lines.push_back(std::move(words));
  }
  return lines.empty()
             ? "nowhere"
             : fmt::format("on line{} {}", lines.size() == 1 ? "" : "s", fmt::join(lines, ", "));
}

std::string variable_markdown(const Source& source, const Part& part,
                              const LanguageOptions& options) {
  const auto& symbol = part.reading.names.symbols[part.here->meaning.symbol];
  const auto kind = symbol.kind == SymbolKind::Local       ? "local variable"
                    : symbol.kind == SymbolKind::Parameter ? "parameter"
                                                           : "variable";
  const auto begins = symbol.kind == SymbolKind::Local       ? "0 at each call"
                      : symbol.kind == SymbolKind::Parameter ? "a copy of what the caller gives"
                                                             : "0 when the program begins";
  auto text = fmt::format("**`{}`** ({}): a 32-bit integer, {}\n\n- set: {}\n- read: {}\n",
                          part.reading.program.name(symbol.name), kind, begins,
                          lines_where(part, Use::Set), lines_where(part, Use::Read));
  if (part.file != 0)
    return text; // the including program assigns its letter
  const auto letters = letters_of(compile_structured(source, options));
  if (const auto letter = letters.find(symbol.span.begin); letter != letters.end())
    text += fmt::format("- the robot's `{}`\n", letter->second);
  return text;
}

std::string declaration_markdown(const Part& part, const structured::Symbol& symbol) {
  const auto place = part.reading.place(symbol.span);
  if (!place)
    return fmt::format("**`{}`**: a macro\n", part.reading.program.name(symbol.name));
  const auto& source = *place->source;
  const auto line = source.position(place->span.begin).line;
  auto text = fmt::format("```{}\n{}\n```\n", structured_language_id, trim(source.line(line)));
  if (const auto above = comment_above(part.reading, symbol.span); !above.empty())
    text += above + "\n";
  if (place->source != part.reading.sources[part.file])
    text += fmt::format("\nin `{}`\n", file_name(source.name()));
  return text;
}

std::string name_markdown(const Source& source, const Part& part, const LanguageOptions& options) {
  const auto& meaning = part.here->meaning;
  if (meaning.symbol == none)
    return fmt::format("**`{}`** (label): jumps to it: {}\n",
                       part.reading.program.name(meaning.name), lines_where(part, Use::Read));
  const auto& symbol = part.reading.names.symbols[meaning.symbol];
  switch (symbol.kind) {
  case SymbolKind::Variable:
  case SymbolKind::Local:
  case SymbolKind::Parameter: return variable_markdown(source, part, options);
  case SymbolKind::Constant:
    return declaration_markdown(part, symbol) +
           fmt::format("the number {}{}\n", symbol.value, symbol.duration ? " (ms)" : "");
  case SymbolKind::Array:
    return declaration_markdown(part, symbol) + fmt::format("elements 1 to {}\n", symbol.value);
  case SymbolKind::Sub:
  case SymbolKind::Function: return declaration_markdown(part, symbol);
  }
  return {};
}

std::optional<std::string> word_markdown(std::string_view text) {
  const auto word = structured::find_word(text);
  const auto spelled = structured::spelling(word);
  const auto section = [&]() -> std::optional<reference::Section> {
    switch (word.kind) {
    case structured::WordKind::Name: return std::nullopt;
    case structured::WordKind::Keyword: return reference::structured_words_section();
    case structured::WordKind::Statement: return reference::statements_section();
    case structured::WordKind::Function: return reference::functions_section();
    case structured::WordKind::Variable: return reference::variables_section();
    }
    return std::nullopt;
  };
  // Words of the robot with more meaning in structured programs have an entry there.
  if (auto wider =
          find_markdown(reference::structured_words_section(), spelled, structured_language_id);
      wider && word.kind != structured::WordKind::Name)
    return wider;
  const auto found = section();
  return found ? find_markdown(*found, spelled.empty() ? text : spelled, structured_language_id)
               : std::nullopt;
}

std::optional<Hover> hover_rule(const Source& source, Span comment, std::uint32_t offset) {
  const auto text = source.text();
  auto begin = std::min(offset, comment.end);
  auto end = begin;
  while (begin > comment.begin && is_rule_part(text[begin - 1]))
    --begin;
  while (end < comment.end && is_rule_part(text[end]))
    ++end;
  const auto word = source.text({begin, end});
  const auto* rule = structured::rules::find(word);
  if (rule == nullptr)
    rule = compiler::rules::find(word);
  if (rule == nullptr)
    return std::nullopt;
  return Hover{{begin, end},
               fmt::format("**{}**: {}\n\n{}\n", rule->id, rule->summary, rule->explanation)};
}

std::optional<Hover> hover(const Source& source, std::uint32_t offset,
                           const LanguageOptions& options) {
  for (const auto& token : tokens_at(source, offset, structured_lexis)) {
    if (offset < token.span.begin || offset > token.span.end)
      continue;
    if (token.kind == TokenKind::Comment)
      return hover_rule(source, token.span, offset);
    if (token.kind == TokenKind::String)
      return std::nullopt;
    if (token.kind != TokenKind::Word)
      continue;
    if (const auto parts = parts_with(source, token.span.begin, options); !parts.empty())
      return Hover{token.span, name_markdown(source, parts.back(), options)};
    if (auto found = word_markdown(source.text(token.span)))
      return Hover{token.span, *std::move(found)};
  }
  return std::nullopt;
}

// ---- outline

OutlineKind kind_of(Kind kind) {
  return kind == Kind::Const   ? OutlineKind::Constant
         : kind == Kind::Array ? OutlineKind::Array
                               : OutlineKind::Function;
}

std::vector<Symbol> outline(const Source& source) {
  const auto reading = read_structured(source, {});
  const auto& program = reading.program;
  std::vector<Symbol> symbols;
  if (program.files.empty())
    return symbols;
  const auto& file = program.files.front();
  for (auto i = file.statements_begin; i < file.statements_end; ++i) {
    const auto& statement = program.statements[i];
    const bool declares = statement.kind == Kind::Sub || statement.kind == Kind::Function ||
                          statement.kind == Kind::Const || statement.kind == Kind::Array;
    if (!declares || statement.name == none)
      continue;
    const auto end =
        statement.next != none ? program.statements[statement.next].span.end : statement.span.end;
    symbols.push_back({std::string(program.text_of(statement.name_span)),
                       std::string(program.text_of(statement.word)),
                       {statement.span.begin, end},
                       statement.name_span,
                       kind_of(statement.kind)});
  }
  return symbols;
}

// ---- changes

std::optional<std::string> why_no_name(std::string_view name) {
  const bool well_formed = !name.empty() && structured::begins_name(name.front()) &&
                           std::all_of(name.begin(), name.end(), structured::is_name_char) &&
                           name.size() <= structured::longest_name;
  if (!well_formed)
    return fmt::format(
        "a name is a letter or `_`, then letters, digits and `_`, at most {} characters in all",
        structured::longest_name);
  if (structured::find_word(name).kind != structured::WordKind::Name)
    return fmt::format("`{}` is a reserved word", name);
  return std::nullopt;
}

/// Why the name cannot be changed in one of its programs; nothing if it can.
std::optional<std::string> why_no_renaming(const Part& part, std::string_view name) {
  const auto old = part.reading.program.text_of(part.here->span);
  bool is_declared = false;
  for (const auto& use : part.uses) {
    if (use.meaning == part.here->meaning)
      is_declared = is_declared || use.is_set;
    else if (equal_words(part.reading.program.text_of(use.span), name))
      return fmt::format("`{}` is already in use", name);
  }
  if (!is_declared)
    return fmt::format("`{}` is declared in another file", old);
  return std::nullopt;
}

tl::expected<Renaming, std::string> rename(const Source& source, std::uint32_t offset,
                                           std::string_view name, const LanguageOptions& options) {
  const auto parts = parts_with(source, offset, options);
  if (parts.empty())
    return tl::unexpected(std::string("this is not a name in the program"));
  if (auto why = why_no_name(name))
    return tl::unexpected(*std::move(why));
  for (const auto& part : parts)
    if (auto why = why_no_renaming(part, name))
      return tl::unexpected(*std::move(why));
  auto found = occurrences(source, offset, options);
  found.uses.insert(found.uses.end(), found.definitions.begin(), found.definitions.end());
  std::sort(found.uses.begin(), found.uses.end(), [](Span a, Span b) { return a.begin < b.begin; });
  Renaming renaming;
  for (const auto span : found.uses)
    renaming.edits.push_back({span, std::string(name)});
  renaming.elsewhere = std::move(found.elsewhere);
  return renaming;
}

std::vector<Diagnostic> check(const Source& source, const LanguageOptions& options) {
  auto found = structured::findings_by_file(compile_structured(source, options).program);
  return found.empty() ? std::vector<Diagnostic>() : std::move(found.front());
}

std::optional<std::string> format(const Source& source) {
  if (compiler::refuse_text(source.text()))
    return std::nullopt;
  return structured::format(source.text());
}

std::vector<Rewrite> rewrites(const Source& source, const LanguageOptions& options) {
  auto fixed = fix_all(std::string(source.text()), [&](std::string_view text) {
    return check(Source(source.name(), std::string(text)), options);
  });
  if (fixed.count == 0)
    return {};
  return {{"apply all safe fixes", "source.fixAll", std::move(fixed.text)}};
}

} // namespace

const LanguageService structured_service = {
    check,  hover,  suggest_structured, outline,           occurrences,
    rename, format, rewrites,           &structured_shape, structured_hints};

} // namespace orb::editor
