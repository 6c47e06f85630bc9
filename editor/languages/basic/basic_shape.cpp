// The look and the calls of an orbBasic program: colours, folds, call hierarchy.

#include "compiler/text/basic_words.h"
#include "compiler/text/parse_basic.h"
#include "editor/languages/basic/basic_names.h"
#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "reference/sections.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace orb::editor {
namespace {

using compiler::Program;
using compiler::WordKind;

// ---- colours

void color_word(Palette& palette, Span span, compiler::Word word) {
  switch (word.kind) {
  case WordKind::Statement: color_statement(palette, span, spec::statements[word.index]); break;
  case WordKind::Particle: palette.add(span, Color::Keyword); break;
  case WordKind::Function: palette.add(span, Color::Function, Robots); break;
  case WordKind::Variable: color_system(palette, span, spec::variables[word.index]); break;
  case WordKind::Letter:
  case WordKind::Unknown: break;
  }
}

bool is_operator(std::string_view sign) {
  return sign.size() == 1 && (spec::find_operator(sign.front()) ||
                              spec::find_relation(sign.front()) || sign == "?" || sign == "$");
}

std::vector<Colored> colors(const Source& source, const LanguageOptions&) {
  const auto program = compiler::parse(source.text());
  Palette palette;
  for (const auto& name : line_names(program))
    palette.add(name.span, Color::Label, name.is_target ? Plain : Declared);
  for (const auto& name : letter_names(program))
    palette.add(name.span, Color::Variable, name.is_set ? Changed : Plain);
  for (const auto& node : program.statements)
    color_word(palette, node.word, compiler::find_word(program.text_of(node.word)));
  for (const auto& token : tokens_of(source, basic_lexis)) {
    const auto text = source.text(token.span);
    color_token(palette, token);
    if (token.kind == TokenKind::Word)
      color_word(palette, token.span, compiler::find_word(text));
    else if (token.kind == TokenKind::Sign && is_operator(text))
      palette.add(token.span, Color::Operator);
  }
  return palette.take();
}

// ---- folds

/// The variable of a line's `for` or `next`; nothing for other lines.
std::optional<std::uint32_t> loop_variable(const Program& program, const compiler::Line& line,
                                           spec::Statement kind) {
  if (!line.has_statement())
    return std::nullopt;
  const auto& node = program.statements[line.statement];
  if (node.error || node.kind != kind)
    return std::nullopt;
  const auto& item = program.items_of(node).front();
  return item.kind == compiler::ItemKind::Letter ? item.value : indexed_letter;
}

std::vector<Fold> folds(const Source& source) {
  const auto program = compiler::parse(source.text());
  auto folds = comment_folds(source, '\'');
  const auto number = [](std::size_t index) { return static_cast<std::uint32_t>(index + 1); };
  for (const auto& part : parts_of(program))
    if (part.is_called)
      add_fold(folds, source, number(part.first), number(part.last));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open; // variable, line
  for (std::size_t i = 0; i < program.lines.size(); ++i) {
    if (const auto v = loop_variable(program, program.lines[i], spec::Statement::For))
      open.emplace_back(*v, number(i));
    const auto closed = loop_variable(program, program.lines[i], spec::Statement::Next);
    if (!closed || open.empty() || open.back().first != *closed)
      continue;
    add_fold(folds, source, open.back().second, number(i) - 1); // keep `next` visible
    open.pop_back();
  }
  return folds;
}

// ---- what surrounds a place

std::vector<Span> around(const Source& source, std::uint32_t offset) {
  const auto program = compiler::parse(source.text());
  std::vector<Span> spans;
  const auto add = [&](Span span) { spans.push_back(span); };
  for (const auto& token : tokens_at(source, offset, basic_lexis))
    add(token.span);
  for (const auto& node : program.nodes)
    add(with_closing(source, node.span));
  for (const auto& item : program.items)
    add(with_closing(source, item.span));
  for (const auto& node : program.statements)
    add(node.span);
  for (const auto& part : parts_of(program))
    add({program.lines[part.first].span.begin, program.lines[part.last].span.end});
  for (const auto& fold : folds(source))
    add({source.line_start(fold.first), end_of_line(source, source.line_start(fold.last))});
  return spans;
}

// ---- signatures

std::optional<Signature> signature(const Source& source, std::uint32_t offset,
                                   const LanguageOptions&) {
  const spec::StatementInfo* row = nullptr;
  std::size_t commas = 0;
  int depth = 0;
  for (const auto& token : tokens_at(source, offset, basic_lexis)) {
    if (token.span.end > offset || (token.kind == TokenKind::Word && token.span.end == offset))
      break;
    const auto text = source.text(token.span);
    const auto word = token.kind == TokenKind::Word ? compiler::find_word(text) : compiler::Word{};
    if (word.kind == WordKind::Statement) {
      row = &spec::statements[word.index];
      commas = 0;
    } else if (text == "then" || text == "else") {
      row = nullptr;
    } else if (text == "(" || text == ")") {
      depth += text == "(" ? 1 : -1;
    } else if (text == "," && depth == 0) {
      ++commas;
    }
  }
  return row == nullptr ? std::nullopt : statement_signature(*row, commas, basic_language_id);
}

// ---- what can be done, and calls

std::vector<Lens> lenses(const Source& source) {
  return run_lenses(source);
}

Calls calls(const Source& source, const LanguageOptions&) {
  const auto program = compiler::parse(source.text());
  Calls all;
  all.callables.push_back({"program", "", nullptr, {0, 0}, {0, 0}});
  if (!program.lines.empty()) {
    all.callables[0].span = {0, static_cast<std::uint32_t>(source.text().size())};
    all.callables[0].selection = program.lines.front().span;
  }
  std::map<std::uint32_t, std::size_t> by_number;
  std::vector<std::size_t> of_line(program.lines.size(), 0);
  for (const auto& part : parts_of(program)) {
    if (!part.is_called)
      continue;
    const auto& first = program.lines[part.first];
    by_number.emplace(first.number, all.callables.size());
    std::fill(of_line.begin() + static_cast<std::ptrdiff_t>(part.first),
              of_line.begin() + static_cast<std::ptrdiff_t>(part.last) + 1, all.callables.size());
    all.callables.push_back({part.title,
                             "subroutine",
                             nullptr,
                             {first.span.begin, program.lines[part.last].span.end},
                             first.number_span});
  }
  for (const auto& name : line_names(program)) {
    const auto callee = by_number.find(name.number);
    if (!name.calls || callee == by_number.end())
      continue;
    const auto line = source.position(name.span.begin).line - 1;
    all.calls.push_back({line < of_line.size() ? of_line[line] : 0, callee->second, name.span});
  }
  return all;
}

} // namespace

const LanguageShape basic_shape = {colors, folds, around, signature, nullptr, lenses, calls};

} // namespace orb::editor
