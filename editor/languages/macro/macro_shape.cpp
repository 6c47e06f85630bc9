// The look and the calls of macro source: colours, folds, call hierarchy.

#include "assembler/text/parse_macro.h"
#include "editor/directives.h"
#include "editor/languages/macro/macro_names.h"
#include "editor/languages/markdown.h"
#include "editor/languages/shape.h"
#include "reference/sections.h"
#include "spec/macro.h"

#include <algorithm>

namespace orb::editor {
namespace {

using assembler::Program;
using assembler::Statement;
using assembler::Value;

bool begins_macro(const Statement& statement) {
  return statement.kind == Statement::Kind::Macro && statement.count > 0;
}

/// The lines of each macro, from `.macro` to the next one.
struct MacroExtent {
  const Statement* head = nullptr;
  Span name;
  Span span;
};

std::vector<MacroExtent> bodies_of(const Source& source, const Program& program) {
  std::vector<MacroExtent> bodies;
  for (const auto& statement : program.statements) {
    if (!begins_macro(statement))
      continue;
    const auto start = source.line_start(source.position(statement.span.begin).line);
    if (!bodies.empty())
      bodies.back().span.end = start;
    bodies.push_back({&statement,
                      program.values_of(statement).front().span,
                      {start, static_cast<std::uint32_t>(source.text().size())}});
  }
  return bodies;
}

std::vector<Colored> colors(const Source& source, const LanguageOptions&) {
  const auto program = assembler::parse(source.text());
  Palette palette;
  for (const auto& statement : program.statements) {
    const bool commands = statement.kind == Statement::Kind::Command;
    palette.add(statement.head, commands ? Color::Function : Color::Keyword,
                commands ? Robots : Plain);
    for (std::uint32_t i = 0; i < statement.count; ++i) {
      const auto& value = program.values_of(statement)[i];
      const bool names_constant = statement.kind == Statement::Kind::Const;
      palette.add(value.name, names_constant ? Color::Variable : Color::Parameter,
                  names_constant ? Declared | Fixed : Plain);
    }
  }
  for (const auto& name : names_in(source, program)) {
    const bool is_macro = std::any_of(
        program.statements.begin(), program.statements.end(), [&](const Statement& one) {
          return begins_macro(one) &&
                 source.text(program.values_of(one).front().span) == source.text(name.span);
        });
    palette.add(name.span, is_macro ? Color::Function : Color::Variable,
                (is_macro ? Plain : Fixed) | (name.is_definition ? Declared : Plain));
  }
  for (const auto& value : program.values)
    if (value.kind == Value::Kind::Word)
      palette.add(value.span, Color::Value, Robots); // a flag or a named value
  for (const auto& token : tokens_of(source, macro_lexis))
    color_token(palette, token);
  return palette.take();
}

std::vector<Fold> folds(const Source& source) {
  using spec::MacroCommand;
  const auto program = assembler::parse(source.text());
  auto folds = comment_folds(source, '#');
  const auto line_of = [&](std::uint32_t offset) { return source.position(offset).line; };
  for (const auto& body : bodies_of(source, program)) {
    const bool is_last = body.span.end == source.text().size();
    add_fold(folds, source, line_of(body.span.begin),
             is_last ? source.line_count() : line_of(body.span.end) - 1);
  }
  const Statement* open = nullptr; // loops do not nest
  for (const auto& statement : program.statements) {
    if (statement.info == nullptr)
      continue;
    const auto command = statement.info->command;
    if (command == MacroCommand::LoopStart || command == MacroCommand::LoopStartSystem)
      open = &statement;
    if (command != MacroCommand::LoopEnd || open == nullptr)
      continue;
    add_fold(folds, source, line_of(open->span.begin), line_of(statement.span.begin) - 1);
    open = nullptr;
  }
  return folds;
}

std::vector<Span> around(const Source& source, std::uint32_t offset) {
  const auto program = assembler::parse(source.text());
  std::vector<Span> spans;
  const auto add = [&](Span span) { spans.push_back(span); };
  for (const auto& token : tokens_at(source, offset, macro_lexis))
    add(token.span);
  for (const auto& statement : program.statements) {
    add(statement.head);
    add(statement.span);
    for (std::uint32_t i = 0; i < statement.count; ++i) {
      const auto& value = program.values_of(statement)[i];
      add(value.span);
      if (value.name.size() > 0)
        add({value.name.begin, value.span.end});
    }
  }
  for (const auto& body : bodies_of(source, program))
    add(body.span);
  return spans;
}

std::optional<Signature> signature(const Source& source, std::uint32_t offset,
                                   const LanguageOptions&) {
  const spec::MacroCommandInfo* row = nullptr;
  std::size_t commas = 0;
  std::string_view operand; ///< the operand given by name
  std::string_view before;
  for (const auto& token : tokens_at(source, offset, macro_lexis)) {
    if (token.span.end > offset || token.kind == TokenKind::Comment)
      break;
    const auto text = source.text(token.span);
    if (row == nullptr && token.span.end < offset)
      row = spec::find_macro_command(text);
    else if (text == ",") {
      ++commas;
      operand = {};
    } else if (text == "=")
      operand = before;
    before = text;
  }
  if (row == nullptr || row->operand_count == 0)
    return std::nullopt;
  SignatureText text(row->mnemonic);
  auto active = commas;
  for (const auto& one : *row) {
    text.add(&one == row->begin() ? " " : ", ", one.name, range_text(one));
    if (one.name == operand)
      active = static_cast<std::size_t>(&one - row->begin());
  }
  auto markdown =
      find_markdown(reference::macro_commands_section(), row->mnemonic, macro_language_id);
  return text.take(active, markdown.value_or(""));
}

/// A run starts with the first macro of a file.
std::vector<Lens> lenses(const Source& source) {
  const auto program = assembler::parse(source.text());
  const auto bodies = bodies_of(source, program);
  if (bodies.empty())
    return program.statements.empty() ? std::vector<Lens>() : run_lenses(source);
  return {{bodies.front().name, Lens::Deed::Run, ""}, {bodies.front().name, Lens::Deed::Debug, ""}};
}

Calls calls(const Source& source, const LanguageOptions&) {
  const auto program = assembler::parse(source.text());
  const auto bodies = bodies_of(source, program);
  Calls all;
  for (const auto& body : bodies)
    all.callables.push_back(
        {std::string(source.text(body.name)), "macro", nullptr, body.span, body.name});
  for (const auto& name : names_in(source, program)) {
    if (name.is_definition)
      continue;
    std::optional<std::size_t> caller;
    std::optional<std::size_t> callee;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].span.begin <= name.span.begin && name.span.begin < bodies[i].span.end)
        caller = i;
      if (source.text(bodies[i].name) == source.text(name.span))
        callee = i;
    }
    if (caller && callee)
      all.calls.push_back({*caller, *callee, name.span});
  }
  return all;
}

} // namespace

const LanguageShape macro_shape = {colors, folds, around, signature, nullptr, lenses, calls};

} // namespace orb::editor
