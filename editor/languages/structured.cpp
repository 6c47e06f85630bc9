// What an editor may ask about a structured program.

#include "assembler/assemble.h"
#include "base/fixes.h"
#include "base/silence.h"
#include "base/text.h"
#include "compiler/check.h"
#include "compiler/text/image.h"
#include "compiler/text/parse.h"
#include "compiler/text/rules.h"
#include "editor/language.h"
#include "editor/languages/structured_names.h"
#include "editor/markdown.h"
#include "editor/shape.h"
#include "editor/text.h"
#include "editor/words.h"
#include "reference/sections.h"
#include "spec/limits.h"
#include "structured/compile.h"
#include "structured/text/blocks.h"
#include "structured/text/format.h"
#include "structured/text/parse.h"
#include "structured/text/read.h"
#include "structured/text/rules.h"
#include "structured/text/words.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <utility>

namespace orb::editor {
namespace {

using structured::Compiled;
using structured::Kind;
using structured::none;
using structured::Program;
using structured::SymbolKind;

constexpr auto language_id = structured_language_id;

// ---- names

/// The name that touches `offset`; of two the one after it wins.
const NameUse* use_at(const std::vector<NameUse>& uses, std::uint32_t offset) {
  const NameUse* found = nullptr;
  for (const auto& use : uses)
    if (use.span.begin <= offset && offset <= use.span.end)
      found = &use;
  return found;
}

/// A program in which a text takes part, and the name of it that is asked about.
struct Part {
  Reading reading;
  std::vector<NameUse> uses;
  const NameUse* here = nullptr; ///< null where there is no name
  std::uint32_t file = 0;        ///< the text among the program's files
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

/// The programs that share the name at `offset`: the text itself, and the open ones that include
/// it.
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

/// Where a macro that `use` brings is written: in a file of its own.
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

/// `in lines 2, 5`; a line of another file with its name: `in lines 2, lib.orb:5`.
std::string lines_where(const Part& part, bool is_set) {
  std::vector<std::string> lines;
  for (const auto& use : part.uses) {
    if (!(use.meaning == part.here->meaning) || use.is_set != is_set)
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
             : fmt::format("in line{} {}", lines.size() == 1 ? "" : "s", fmt::join(lines, ", "));
}

/// The letter of the robot that holds a name of the main file, once it compiles.
std::map<std::uint32_t, char> letters_of(const Compiled& compiled) {
  std::map<std::uint32_t, char> letters; // by where the name is declared
  for (std::size_t v = 1; v < compiled.code.variables.size() && v < compiled.letters.of.size();
       ++v) {
    const auto symbol = compiled.code.variables[v].symbol;
    if (symbol != none && compiled.letters.of[v] != structured::no_letter)
      letters[compiled.names.symbols[symbol].span.begin] =
          spec::letter_name(compiled.letters.of[v]);
  }
  return letters;
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
  auto text = fmt::format("**`{}`** ({}): a whole number of 32 bits, {}\n\n- set: {}\n- read: {}\n",
                          part.reading.program.name(symbol.name), kind, begins,
                          lines_where(part, true), lines_where(part, false));
  if (part.file != 0)
    return text; // its letter is one of the program that includes it
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
  auto text = fmt::format("```{}\n{}\n```\n", language_id, trim(source.line(line)));
  if (const auto above = comment_above(part.reading, symbol.span); !above.empty())
    text += above + "\n";
  if (place->source != part.reading.sources[part.file])
    text += fmt::format("\nin `{}`\n", file_name(source.name()));
  return text;
}

std::string name_markdown(const Source& source, const Part& part, const LanguageOptions& options) {
  const auto& meaning = part.here->meaning;
  if (meaning.symbol == none)
    return fmt::format("**`{}`** (label): jumped to {}\n", part.reading.program.name(meaning.name),
                       lines_where(part, false));
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
  // Words of the robot that mean more here have an entry of their own.
  if (auto wider = find_markdown(reference::structured_words_section(), spelled, language_id);
      wider && word.kind != structured::WordKind::Name)
    return wider;
  const auto found = section();
  return found ? find_markdown(*found, spelled.empty() ? text : spelled, language_id)
               : std::nullopt;
}

bool is_rule_part(char c) {
  return is_letter(c) || is_digit(c) || c == '-';
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

// ---- completion

enum class Context : std::uint8_t { Statement, Expression, Label, Block, Macro };

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
                              entry_markdown(section, section.entries[i], language_id)});
    }
  }

  void rows(const reference::Section& section, SuggestionKind kind) {
    for (const auto& entry : section.entries)
      out_.items.push_back(
          {entry.name, kind, entry.summary, entry_markdown(section, entry, language_id)});
  }

  void words(const reference::Section& section) {
    for (const auto& entry : section.entries) {
      const bool listed =
          std::any_of(out_.items.begin(), out_.items.end(),
                      [&](const Suggestion& item) { return item.label == entry.name; });
      if (!listed)
        out_.items.push_back({entry.name, SuggestionKind::Keyword, entry.summary,
                              entry_markdown(section, entry, language_id)});
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

Suggestions suggest(const Source& source, std::uint32_t offset, const LanguageOptions& options) {
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
        "a name is a letter or `_`, then letters, digits and `_`, at most {} of them",
        structured::longest_name);
  if (structured::find_word(name).kind != structured::WordKind::Name)
    return fmt::format("`{}` is a word of the language", name);
  return std::nullopt;
}

/// Why the name cannot become another one in one of its programs; nothing where it can.
std::optional<std::string> why_no_renaming(const Part& part, std::string_view name) {
  const auto old = part.reading.program.text_of(part.here->span);
  bool is_declared = false;
  for (const auto& use : part.uses) {
    if (use.meaning == part.here->meaning)
      is_declared = is_declared || use.is_set;
    else if (equal_words(part.reading.program.text_of(use.span), name))
      return fmt::format("`{}` is in use already", name);
  }
  if (!is_declared)
    return fmt::format("`{}` is declared in another file", old);
  return std::nullopt;
}

tl::expected<Renaming, std::string> rename(const Source& source, std::uint32_t offset,
                                           std::string_view name, const LanguageOptions& options) {
  const auto parts = parts_with(source, offset, options);
  if (parts.empty())
    return tl::unexpected(std::string("this is not a name of the program"));
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

// ---- hints

/// The bytes of the image that each routine takes where it stands.
std::map<std::uint32_t, std::uint32_t> bytes_of(const Compiled& compiled) {
  std::map<std::uint32_t, std::uint32_t> bytes;
  const auto plain = compiler::parse(compiled.robot.text);
  const auto image = compiler::build_image(plain, compiler::Packing::Packed);
  for (std::size_t i = 0; i < image.lines.size() && i < compiled.robot.lines.size(); ++i)
    bytes[compiled.robot.lines[i].routine] += image.lines[i].size;
  return bytes;
}

/// Numbers and constants given to the robot's statements; a duration says itself.
void hint_numbers(const Compiled& compiled, std::uint32_t end, std::vector<Hint>& found) {
  for (const auto& statement : compiled.program.statements) {
    if (statement.kind != Kind::Robot || statement.span.end > end)
      continue;
    const auto parameters = spec::info(statement.robot).parameters();
    auto parameter = parameters.begin();
    for (const auto& item : compiled.program.items_of(statement)) {
      if (item.kind != structured::ItemKind::Expression || parameter == parameters.end())
        continue;
      const auto& root = compiled.program.nodes[item.value];
      const auto value = structured::evaluate(compiled.program, compiled.names, item.value);
      const bool is_plain =
          root.kind == structured::NodeKind::Number || root.kind == structured::NodeKind::Name;
      if (value && is_plain)
        if (auto hint = number_hint(parameter->name, parameter->unit, value->value, item.span.end))
          found.push_back(*std::move(hint));
      ++parameter;
    }
  }
}

std::vector<Hint> hints(const Source& source, const LanguageOptions& options) {
  const auto compiled = compile_structured(source, options);
  std::vector<Hint> found;
  if (compiled.robot.lines.empty() || compiled.has_errors())
    return found;
  hint_numbers(compiled, compiled.program.files.front().end, found);
  const auto end = compiled.program.files.front().end;
  for (const auto& [at, letter] : letters_of(compiled))
    if (at < end) {
      const auto name =
          std::find_if(compiled.names.symbols.begin(), compiled.names.symbols.end(),
                       [start = at](const auto& symbol) { return symbol.span.begin == start; });
      found.push_back({name->span.end, fmt::format(": {}", letter),
                       fmt::format("the robot's `{}` holds it", letter)});
    }
  const auto bytes = bytes_of(compiled);
  for (std::uint32_t r = 1; r < compiled.names.routines.size(); ++r) {
    const auto& header = compiled.program.statements[compiled.names.routines[r].statement];
    if (header.span.begin >= end)
      continue;
    const auto own = bytes.find(r);
    found.push_back(
        {end_of_line(source, header.span.begin),
         own == bytes.end() ? "no bytes of its own" : fmt::format("{} bytes", own->second),
         own == bytes.end() ? "it is written into its callers, or never called"
                            : "of the packed image"});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Hint& a, const Hint& b) { return a.at < b.at; });
  return found;
}

} // namespace

const LanguageService structured_service = {
    check,  hover,  suggest,  outline,           occurrences,
    rename, format, rewrites, &structured_shape, hints};

} // namespace orb::editor
