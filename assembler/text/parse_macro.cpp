#include "assembler/text/parse_macro.h"

#include "assembler/text/grammar.h"
#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "base/fixes.h"
#include "base/meant.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "base/units.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <optional>

namespace orb::assembler {
namespace {

namespace g = grammar;

constexpr std::size_t most_diagnostics = 1000; // nobody reads more

struct Directive {
  std::string_view word;
  Statement::Kind kind;
};
constexpr Directive directives[] = {{".macro", Statement::Kind::Macro},
                                    {".const", Statement::Kind::Const},
                                    {".raw", Statement::Kind::Raw},
                                    {".noend", Statement::Kind::NoEnd}};

/// The error of a line: thrown by the grammar's must<>, caught at the end of the line.
struct ParseStop {
  enum class Expected : std::uint8_t { Value, ClosingQuote, Operand, NothingMore };
  Expected expected;
  const char* at;
};

/// Collects the current line and commits it once it is complete.
struct Builder {
  Program& program;
  const char* text;
  Statement statement;
  bool named = false;

  std::uint32_t offset(const char* at) const { return static_cast<std::uint32_t>(at - text); }
  Span span(const char* begin, const char* end) const { return {offset(begin), offset(end)}; }

  void head(const char* begin, const char* end) {
    statement = {};
    statement.head = statement.span = span(begin, end);
    statement.first = static_cast<std::uint32_t>(program.values.size());
    named = false;
  }

  Value& add(Value::Kind kind, const char* begin, const char* end) {
    if (!named)
      program.values.emplace_back();
    named = false;
    auto& value = program.values.back();
    value.kind = kind;
    value.span = span(begin, end);
    statement.span.end = value.span.end;
    return value;
  }

  void equals() {
    // The value before the `=` is the name of the next value.
    auto& value = program.values.back();
    value.name = value.span;
    named = true;
  }
};

constexpr std::array macro_units{unit::ms, unit::s, unit::deg};

void read_number(Value& value, std::string_view text) {
  const auto digits = text.substr(text.starts_with('-') || text.starts_with('+') ? 1 : 0);
  const auto amount = split_amount(digits);
  if (const auto hex = hexadecimal(digits)) {
    value.thousandths = std::min(*hex, largest_number) * whole;
  } else {
    const auto steps = steps_of(amount.number, whole);
    value.thousandths = largest_number * whole;
    if (steps)
      value.thousandths = std::min(steps->count, value.thousandths);
    value.unit = find_unit(amount.rest, macro_units);
    value.is_known = (!steps || steps->exact) && (value.unit != nullptr || amount.rest.empty());
  }
  if (text.starts_with('-'))
    value.thousandths = -value.thousandths;
}

ORB_ACTIONS

ORB_ACTION(g::mnemonic, builder.head(in.begin(), in.end());
           builder.statement.info = spec::find_macro_command(in.string_view()))
ORB_ACTION(g::directive, builder.head(in.begin(), in.end());
           builder.statement.kind = Statement::Kind::NoEnd)
ORB_ACTION(g::word, builder.add(Value::Kind::Word, in.begin(), in.end()))
ORB_ACTION(g::equals, builder.equals())
ORB_ACTION(g::number,
           read_number(builder.add(Value::Kind::Number, in.begin(), in.end()), in.string_view()))
ORB_ACTION(g::text, builder.add(Value::Kind::Text, in.begin(), in.end()))

template <typename Rule>
constexpr auto reason = ParseStop::Expected::NothingMore;
ORB_REASON(ParseStop::Expected::Value, g::assigned)
ORB_REASON(ParseStop::Expected::ClosingQuote, g::closing_quote)
ORB_REASON(ParseStop::Expected::Operand, g::next_operand)

ORB_CONTROL

/// The character at a place; empty for a control character or bytes that are not UTF-8.
std::string character_at(const char* at, const char* end) {
  const std::string_view text(at, static_cast<std::size_t>(end - at));
  const auto size = utf8_length(text);
  return size > 1 || (*at >= ' ' && *at <= '~') ? std::string(text.substr(0, size)) : "";
}

std::string hex_of(char c) {
  return fmt::format("{:02X}h", static_cast<unsigned char>(c));
}

/// Says what was expected and what was found.
Message found(Message problem, const char* at, const char* end) {
  if (at == end)
    return texts::FoundEnd(std::move(problem));
  const auto character = character_at(at, end);
  return character.empty() ? texts::FoundByte(std::move(problem), hex_of(*at))
                           : texts::Found(std::move(problem), character);
}

Diagnostic explain(const Builder& builder, const ParseStop& stop, const char* end) {
  const auto at = builder.offset(stop.at);
  const Span span{at, at + (stop.at == end ? 0U : 1U)};
  switch (stop.expected) {
  case ParseStop::Expected::Value:
    return finding(rules::Syntax, span, found(texts::ExpectedValue(), stop.at, end),
                   texts::WriteValue());
  case ParseStop::Expected::ClosingQuote:
    if (stop.at != end)
      return finding(rules::Syntax, span, texts::BadEscape(), texts::WriteEscape());
    return finding(rules::Syntax, span, texts::UnterminatedString(), texts::Add('"'));
  case ParseStop::Expected::Operand:
    return finding(rules::Syntax, span, found(texts::ExpectedOperand(), stop.at, end));
  case ParseStop::Expected::NothingMore: break;
  }
  Message help;
  if (*stop.at == '\'' || *stop.at == '/' || *stop.at == '*')
    help = texts::RemarksBegin();
  else if (*stop.at == '=')
    help = texts::Write("name=value");
  else if (*stop.at == ':')
    help = texts::NoLabels();
  else if (*stop.at == '\\')
    help = texts::NeedsQuotes();
  const auto character = character_at(stop.at, end);
  return finding(rules::Syntax, span,
                 character.empty() ? texts::UnexpectedByte(hex_of(*stop.at))
                                   : texts::Unexpected(character),
                 std::move(help));
}

/// True if a line begins with a word that starts no macro line.
bool is_foreign(const Builder& builder) {
  const auto& statement = builder.statement;
  return statement.head.size() > 0 && statement.info == nullptr &&
         builder.text[statement.head.begin] != '.';
}

/// Reports an unknown command. The word may extend to `end`: `console.log`.
Diagnostic unknown_command(const Builder& builder, const char* end) {
  auto span = builder.statement.head;
  const auto is_part = [&](std::uint32_t at) {
    const char c = builder.text[at];
    return is_letter(c) || is_digit(c) || c == '_';
  };
  const auto limit = builder.offset(end);
  while (span.end < limit && (is_part(span.end) || (builder.text[span.end] == '.' &&
                                                    span.end + 1 < limit && is_part(span.end + 1))))
    ++span.end;
  const std::string_view word{builder.text + span.begin, span.size()};
  std::array<std::string_view, std::size(spec::macro_commands)> names;
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = spec::macro_commands[i].mnemonic;
  auto diagnostic = finding(rules::UnknownCommand, span, texts::NotACommand(word),
                            meant_or(word, names, texts::ListsCommands("orb spec")));
  if (const auto meant = closest(word, names))
    diagnostic.fix = single_fix(texts::Write(*meant), span, *meant, Safety::Unsafe);
  return diagnostic;
}

Diagnostic unknown_directive(std::string_view word, Span span) {
  std::array<std::string_view, std::size(directives)> names;
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = directives[i].word;
  return finding(rules::UnknownDirective, span, texts::NotADirective(word),
                 meant_or(word, names, texts::DirectivesAre()));
}

/// Adds the line to the program, or returns its error.
std::optional<Diagnostic> commit(Builder& builder) {
  auto& statement = builder.statement;
  const std::string_view word{builder.text + statement.head.begin, statement.head.size()};
  statement.count = static_cast<std::uint32_t>(builder.program.values.size()) - statement.first;
  if (word[0] == '.') {
    const auto* row = std::find_if(std::begin(directives), std::end(directives),
                                   [&](const Directive& d) { return d.word == word; });
    if (row == std::end(directives))
      return unknown_directive(word, statement.head);
    statement.kind = row->kind;
  } else if (statement.info == nullptr) {
    return unknown_command(builder, builder.text + statement.head.end);
  }
  builder.program.statements.push_back(statement);
  return std::nullopt;
}

/// Parses the line at [begin, end). PEGTL reports failures by exception; they are caught here.
std::optional<Diagnostic> parse_line(Builder& builder, const char* begin, const char* end) {
  const auto values = builder.program.values.size();
  builder.statement.head = {};
  std::optional<Diagnostic> problem;
  try {
    peg::Input input(begin, end, "");
    tao::pegtl::parse<g::line, Action, Control>(input, builder);
    if (builder.statement.head.size() > 0)
      problem = commit(builder);
  } catch (const ParseStop& stop) {
    const bool label = stop.at != end && *stop.at == ':';
    problem =
        is_foreign(builder) && !label ? unknown_command(builder, end) : explain(builder, stop, end);
  }
  if (problem)
    builder.program.values.resize(values);
  return problem;
}

const char* find(const char* at, const char* end, char c) {
  const auto* found = std::memchr(at, c, static_cast<std::size_t>(end - at));
  return found == nullptr ? end : static_cast<const char*>(found);
}

} // namespace

Program parse(std::string_view text) {
  Program program;
  program.text = text;
  // A short command with its operands takes about this much source.
  program.statements.reserve(text.size() / 16);
  program.values.reserve(text.size() / 8);
  Builder builder{program, text.data(), {}, false};
  const char* const end = text.data() + text.size();
  const char* return_at = find(text.data(), end, '\r'); // most files have none
  for (const char* at = text.data(); at != end;) {
    if (return_at < at)
      return_at = find(at, end, '\r');
    const char* stop = find(at, return_at, '\n');
    at += byte_order_mark_size({at, static_cast<std::size_t>(stop - at)});
    if (auto problem = parse_line(builder, at, stop);
        problem && program.diagnostics.size() < most_diagnostics)
      program.diagnostics.push_back(std::move(*problem));
    at = stop == end ? end : stop + 1;
  }
  return program;
}

} // namespace orb::assembler
