// The look, the links and the calls of a structured program.

#include "base/text/text.h"
#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "editor/languages/structured/structured_names.h"
#include "editor/text_places.h"
#include "reference/sections.h"
#include "structured/text/link_blocks.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

using structured::ItemKind;
using structured::Kind;
using structured::none;
using structured::Statement;
using structured::SymbolKind;
using structured::WordKind;

/// The statements of the text itself, without those of included files.
std::vector<const Statement*> own_statements(const structured::Program& program) {
  std::vector<const Statement*> own;
  if (program.files.empty())
    return own;
  const auto& file = program.files.front();
  for (auto i = file.statements_begin; i < file.statements_end; ++i)
    own.push_back(&program.statements[i]);
  return own;
}

// ---- colours

void color_name(Palette& palette, const Reading& reading, const NameUse& use) {
  const unsigned set = use.is_set ? Changed : Plain;
  const unsigned declared = use.is_set ? Declared : Plain;
  if (use.meaning.symbol == none) {
    palette.add(use.span, Color::Label, declared);
    return;
  }
  switch (reading.names.symbols[use.meaning.symbol].kind) {
  case SymbolKind::Variable:
  case SymbolKind::Local:
  case SymbolKind::Array: palette.add(use.span, Color::Variable, set); break;
  case SymbolKind::Parameter: palette.add(use.span, Color::Parameter, set); break;
  case SymbolKind::Constant: palette.add(use.span, Color::Variable, Fixed | declared); break;
  case SymbolKind::Sub:
  case SymbolKind::Function: palette.add(use.span, Color::Function, declared); break;
  }
}

void color_word(Palette& palette, Span span, structured::Word word) {
  switch (word.kind) {
  case WordKind::Name: break;
  case WordKind::Keyword: palette.add(span, Color::Keyword); break;
  case WordKind::Statement: color_statement(palette, span, spec::statements[word.index]); break;
  case WordKind::Function: palette.add(span, Color::Function, Robots); break;
  case WordKind::Variable: color_system(palette, span, spec::variables[word.index]); break;
  }
}

std::vector<Colored> colors(const Source& source, const LanguageOptions& options) {
  const auto reading = read_structured(source, options);
  Palette palette;
  if (reading.program.files.empty())
    return {};
  const auto end = reading.program.files.front().end;
  for (const auto& use : name_uses(reading))
    if (use.span.end <= end)
      color_name(palette, reading, use);
  for (const auto* statement : own_statements(reading.program))
    for (const auto& item : reading.program.items_of(*statement))
      if (item.kind == ItemKind::Colour)
        palette.add(item.span, Color::Value);
  for (const auto& token : tokens_of(source, structured_lexis)) {
    const auto text = source.text(token.span);
    color_token(palette, token);
    if (token.kind == TokenKind::Word)
      color_word(palette, token.span, structured::find_word(text));
    else if (token.kind == TokenKind::Sign && text.find_first_of("(),;:[]") == text.npos)
      palette.add(token.span, Color::Operator);
  }
  return palette.take();
}

// ---- folds and what surrounds a place

std::vector<Fold> folds(const Source& source) {
  const auto reading = read_structured(source, {});
  auto folds = comment_folds(source, '\'');
  for (const auto* statement : own_statements(reading.program)) {
    const bool begins =
        structured::opens_block(statement->kind) || structured::parts_block(statement->kind);
    if (!begins || statement->next == none || statement->one_line)
      continue;
    const auto& next = reading.program.statements[statement->next];
    add_fold(folds, source, source.position(statement->span.begin).line,
             source.position(next.span.begin).line - 1); // keep its end visible
  }
  return folds;
}

std::vector<Span> around(const Source& source, std::uint32_t offset) {
  const auto reading = read_structured(source, {});
  const auto& program = reading.program;
  std::vector<Span> spans;
  const auto add = [&](Span span) { spans.push_back(span); };
  for (const auto& token : tokens_at(source, offset, structured_lexis))
    add(token.span);
  for (const auto& node : program.nodes)
    if (node.span.end <= source.text().size()) // only nodes of this file
      add(with_closing(source, node.span));
  for (const auto* statement : own_statements(program)) {
    add(statement->span);
    for (const auto& item : program.items_of(*statement))
      add(with_closing(source, item.span));
    if (statement->next == none)
      continue;
    const auto& next = program.statements[statement->next];
    add({statement->span.begin, next.span.end}); // including the word that ends it
    add({end_of_line(source, statement->span.end), next.span.begin});
    if (!structured::opens_block(statement->kind))
      continue;
    const auto* last = &next;
    while (last->next != none)
      last = &program.statements[last->next];
    add({statement->span.begin, last->span.end});
  }
  return spans;
}

// ---- signatures

/// What is being written: the innermost open parenthesis, or the statement.
struct Written {
  std::string_view word; ///< before the parenthesis, or that of the statement
  std::size_t commas = 0;
  bool is_statement = false;
};

std::vector<Written> written_before(const Source& source, std::uint32_t offset) {
  std::vector<Written> open{{{}, 0, true}};
  std::string_view before;
  for (const auto& token : tokens_at(source, offset, structured_lexis)) {
    if (token.span.end > offset || (token.kind == TokenKind::Word && token.span.end == offset))
      break;
    const auto text = source.text(token.span);
    const auto word = structured::find_word(text);
    if (text == "(" || text == "[") {
      open.push_back({text == "(" ? before : std::string_view(), 0, false});
    } else if ((text == ")" || text == "]") && open.size() > 1) {
      open.pop_back();
    } else if (text == ",") {
      ++open.back().commas;
    } else if (word.is(structured::Keyword::Then) || word.is(structured::Keyword::Else)) {
      open.assign(1, {{}, 0, true});
    } else if (token.kind == TokenKind::Word && open.size() == 1 && open[0].word.empty()) {
      open[0].word = text;
    }
    before = token.kind == TokenKind::Word ? text : std::string_view();
  }
  return open;
}

std::optional<Signature> routine_signature(const Reading& reading, std::string_view name,
                                           std::size_t commas) {
  const auto& program = reading.program;
  for (const auto& routine : reading.names.routines) {
    if (routine.symbol == none || routine.parameters == 0)
      continue;
    const auto& symbol = reading.names.symbols[routine.symbol];
    if (!equal_words(program.name(symbol.name), name))
      continue;
    SignatureText text(program.text_of(symbol.span));
    for (std::uint32_t p = 0; p < routine.parameters; ++p)
      text.add(p == 0 ? "(" : ", ",
               program.text_of(reading.names.symbols[routine.first_parameter + p].span), "");
    text.close(")");
    return text.take(commas, comment_above(reading, symbol.span));
  }
  return std::nullopt;
}

std::optional<Signature> signature(const Source& source, std::uint32_t offset,
                                   const LanguageOptions& options) {
  const auto open = written_before(source, offset);
  const auto reading = read_structured(source, options);
  for (auto written = open.rbegin(); written != open.rend(); ++written) {
    if (written->word.empty())
      continue;
    const auto word = structured::find_word(written->word);
    if (auto found = routine_signature(reading, written->word, written->commas))
      return found;
    if (written->is_statement && word.kind == WordKind::Statement)
      return statement_signature(spec::statements[word.index], written->commas,
                                 structured_language_id);
    if (written->is_statement || word.kind != WordKind::Keyword)
      continue;
    const auto& row = structured::keywords[word.index]; // `min(a, b)`
    return SignatureText(row.usage).take(written->commas, std::string(row.summary));
  }
  return std::nullopt;
}

// ---- links, deeds, calls

std::vector<Link> links(const Source& source) {
  const auto reading = read_structured(source, {});
  const auto folder = path_of_uri(source.name());
  std::vector<Link> links;
  for (const auto* statement : own_statements(reading.program)) {
    if (statement->kind != Kind::Use && statement->kind != Kind::Include)
      continue;
    for (const auto& item : reading.program.items_of(*statement)) {
      const Span name{item.span.begin + 1, item.span.end - 1};
      if (item.kind == ItemKind::String && item.span.size() > 2)
        links.push_back({name, structured::resolve_path(folder, source.text(name))});
    }
  }
  return links;
}

std::vector<Lens> lenses(const Source& source) {
  return run_lenses(source);
}

Callable callable_of(const Reading& reading, const structured::Routine& routine) {
  const auto& program = reading.program;
  if (routine.symbol == none) {
    const auto& file = program.files.front();
    return {"program", "", nullptr, {file.begin, file.end}, {file.begin, file.begin}};
  }
  const auto& symbol = reading.names.symbols[routine.symbol];
  const auto& header = program.statements[routine.statement];
  const auto end = header.next == none ? header.span.end : program.statements[header.next].span.end;
  Callable one{std::string(program.name(symbol.name)),
               std::string(program.text_of(header.word)),
               nullptr,
               {header.span.begin, end},
               symbol.span};
  const auto place = reading.place(one.span);
  const auto selection = reading.place(symbol.span);
  if (place && selection && place->source != reading.sources.front())
    one = {one.name, one.detail, place->source, place->span, selection->span};
  return one;
}

Calls calls(const Source& source, const LanguageOptions& options) {
  const auto reading = read_structured(source, options);
  Calls all;
  if (reading.program.files.empty())
    return all;
  for (const auto& routine : reading.names.routines)
    all.callables.push_back(callable_of(reading, routine));
  const auto routine_at = [&](std::uint32_t offset) {
    const auto& statements = reading.program.statements;
    for (std::uint32_t i = 0; i < statements.size(); ++i)
      if (statements[i].span.begin <= offset && offset < statements[i].span.end)
        return reading.names.routine_of[i];
    return std::uint32_t{0};
  };
  for (const auto& use : name_uses(reading)) {
    if (use.is_set || use.meaning.symbol == none)
      continue;
    const auto& symbol = reading.names.symbols[use.meaning.symbol];
    const bool calls = symbol.kind == SymbolKind::Sub || symbol.kind == SymbolKind::Function;
    const auto place = reading.place(use.span);
    if (calls && place)
      all.calls.push_back({routine_at(use.span.begin), symbol.routine, place->span});
  }
  return all;
}

} // namespace

const LanguageShape structured_shape = {colors, folds, around, signature, links, lenses, calls};

} // namespace orb::editor
