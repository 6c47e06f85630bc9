#include "compiler/text/image.h"

#include "compiler/text/basic_words.h"
#include "compiler/text/print.h"

#include <string_view>

namespace orb::compiler {
namespace {

/// The part of a statement that the image omits: `let` and the spaces after it.
Span let_span(const Program& program, const StatementNode& statement) {
  if (statement.error || statement.spelling != Spelling::Let)
    return {};
  return {statement.word.begin, program.as<LetView>(statement).variable.span.begin};
}

/// Copies source text; a tab outside a string becomes a space.
void copy(std::string& out, std::string_view text) {
  bool in_string = false;
  for (const char c : text) {
    in_string = in_string != (c == '"');
    out += c == '\t' && !in_string ? ' ' : c;
  }
}

/// Copies a statement without its `let`s.
void copy_statement(std::string& out, const Program& program, const StatementNode& statement) {
  auto at = statement.span.begin;
  const auto skip = [&](Span span) {
    if (span.size() == 0)
      return;
    copy(out, program.text.substr(at, span.begin - at));
    at = span.end;
  };
  for (const auto& part : program.whole(statement))
    skip(let_span(program, part));
  copy(out, program.text.substr(at, statement.span.end - at));
}

std::string_view number_text(const Program& program, const Line& line, Packing packing) {
  auto text = program.text_of(line.number_span);
  while (packing == Packing::Packed && text.size() > 1 && text.front() == '0')
    text.remove_prefix(1);
  return text;
}

} // namespace

Image build_image(const Program& program, Packing packing) {
  Image image;
  image.bytes.reserve(program.text.size() + 1);
  for (std::uint32_t i = 0; i < program.lines.size(); ++i) {
    const auto& line = program.lines[i];
    if (!line.has_statement())
      continue;
    const auto offset = static_cast<std::uint32_t>(image.bytes.size());
    const auto& statement = program.statements[line.statement];
    if (line.number_span.size() > 0) {
      image.bytes += number_text(program, line, packing);
      image.bytes += ' ';
    }
    if (packing == Packing::Packed)
      image.bytes += print(program, statement, Layout::Packed);
    else
      copy_statement(image.bytes, program, statement);
    image.bytes += '\n';
    image.lines.push_back(
        {i + 1, line.number, offset, static_cast<std::uint32_t>(image.bytes.size()) - offset});
  }
  image.bytes += '\0';
  return image;
}

std::size_t image_size(const Program& program, std::uint32_t index) {
  const auto& line = program.lines[index];
  if (!line.has_statement())
    return 0;
  const auto& statement = program.statements[line.statement];
  std::size_t size = statement.span.size() + 1;
  if (line.number_span.size() > 0)
    size += line.number_span.size() + 1;
  for (const auto& part : program.whole(statement))
    size -= let_span(program, part).size();
  return size;
}

std::size_t image_size(const Program& program) {
  std::size_t size = 1;
  for (std::uint32_t i = 0; i < program.lines.size(); ++i)
    size += image_size(program, i);
  return size;
}

} // namespace orb::compiler
