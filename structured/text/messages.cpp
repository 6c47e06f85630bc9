#include "structured/text/messages.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "compiler/text/texts.h"
#include "repair/tokens.h"
#include "spec/limits.h"
#include "structured/text/foreign.h"
#include "structured/text/rules.h"
#include "structured/text/texts.h"
#include "structured/text/words.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace orb::structured {
namespace {

Diagnostic malformed(const Program& program, Span found, Message problem, Message help = {}) {
  return finding(rules::MalformedLine, found,
                 found.size() == 0 ? texts::UnexpectedEnd(std::move(problem))
                                   : texts::Found(std::move(problem), program.text_of(found)),
                 std::move(help));
}

/// What stands before a place, blanks and the ends of lines apart.
char sign_before(std::string_view text, std::uint32_t at) {
  while (at > 0 && (is_blank(text[at - 1]) || is_line_end(text[at - 1])))
    --at;
  return at == 0 ? '\n' : text[at - 1];
}

/// The name or word that ends before a place, blanks apart.
Span word_before(std::string_view text, std::uint32_t at) {
  while (at > 0 && is_blank(text[at - 1]))
    --at;
  auto begin = at;
  while (begin > 0 && is_name_char(text[begin - 1]))
    --begin;
  return {begin, at};
}

bool begins_line(std::string_view text, std::uint32_t at) {
  while (at > 0 && is_blank(text[at - 1]))
    --at;
  return at == 0 || is_line_end(text[at - 1]);
}

/// The word that begins the line of a place.
std::string_view first_word(std::string_view text, std::uint32_t at) {
  while (at > 0 && !is_line_end(text[at - 1]))
    --at;
  while (at < text.size() && is_blank(text[at]))
    ++at;
  const char* const begin = text.data() + at;
  const char* const end = end_of_name(begin, text.data() + text.size());
  return {begin, static_cast<std::size_t>(end - begin)};
}

/// What stands after a complete statement.
Diagnostic trailing(const Program& program, Span found) {
  const auto text = program.text_of(found);
  const auto statement = first_word(program.text, found.begin);
  const char before = sign_before(program.text, found.begin);
  if (before == ',' && begins_line(program.text, found.begin))
    return malformed(program, found, texts::CommaContinues(), texts::TrailingSpace());
  if (text == "=" && before == ')' && find_word(statement).kind == WordKind::Name) {
    const std::string_view all = program.text;
    const auto end = std::min(all.find_first_of("'\r\n", found.end), all.size());
    const auto index = all.find('(', static_cast<std::size_t>(statement.data() - all.data())) + 1;
    return malformed(
        program, found, texts::IndexInBrackets(),
        texts::Write(fmt::format("{}[{}] = {}", statement,
                                 trim(all.substr(index, all.rfind(')', found.begin) - index)),
                                 trim(all.substr(found.end, end - found.end)))));
  }
  if (text == "=" && before == ']' && equal_words(statement, "array"))
    return malformed(program, found, texts::NoInitialValues(), texts::SetEach());
  if (text == ":")
    return finding(rules::ForeignWord, found, texts::DoesNotSeparate(text), texts::OnePerLine());
  if (text == "+" && before == '"')
    return malformed(program, found, texts::NoConcatenation(), texts::PartsSideBySide());
  if (is_digit(before) &&
      (equal_words(text, "ms") || equal_words(text, "s") || equal_words(text, "min")))
    return malformed(program, {word_before(program.text, found.begin).begin, found.end},
                     texts::UnitFollows(),
                     texts::Write(fmt::format(
                         "{}{}", program.text_of(word_before(program.text, found.begin)), text)));
  if (equal_words(statement, "loop"))
    return malformed(program, found, texts::TakesNoCount("loop"), texts::RepeatCounts());
  const auto word = find_word(statement);
  if (word.kind == WordKind::Statement &&
      spec::statements[word.index].form == spec::Form::Arguments && is_name_char(before) &&
      is_digit(text.front()))
    return malformed(program, found, texts::TextAfterStatement(), texts::SeparateValues());
  return malformed(program, found, texts::TextAfterStatement());
}

/// A value that is missing at the end of a line shows in the next one, but is to be written there.
Diagnostic missing_value(const Program& program, Span found) {
  const std::string_view text = program.text;
  auto end = found.begin;
  while (end > 0 && (is_blank(text[end - 1]) || is_line_end(text[end - 1])))
    --end;
  if (!begins_line(text, found.begin) || end == 0 || is_name_char(text[end - 1]))
    return malformed(program, found, texts::MissingValue());
  return finding(rules::MalformedLine, {end - 1, end}, texts::MissingValueAfter(text[end - 1]));
}

/// Values after a name without parentheses: a statement that is misspelt, or a call.
Diagnostic naked_arguments(const Program& program, Span found) {
  const auto called = word_before(program.text, found.begin);
  if (auto known = name_foreign(program, called, Stands::First))
    return *std::move(known);
  const auto word = std::string(program.text_of(called));
  if (program.text[found.begin] == '$')
    return finding(rules::MalformedLine, found, texts::NoDollar(), texts::OnlyIntegers());
  if (spec::find_operator(program.text[found.begin]))
    return malformed(program, found, texts::ValueNoStatement(), texts::SetOrPrint(word));
  std::vector<std::string_view> statements;
  for (const auto& row : spec::statements)
    statements.push_back(row.word);
  if (const auto meant = closest(word, statements))
    return finding(rules::UnknownName, called, texts::NeitherStatementNorSub(word),
                   texts::DidYouMean(*meant));
  return malformed(program, found, texts::CallInParentheses());
}

/// Whether `=` or `+=` and the like stand at a place.
bool assigns(std::string_view text, std::size_t at) {
  if (at < text.size() && std::string_view("+-*/%").find(text[at]) != std::string_view::npos)
    ++at;
  return at < text.size() && text[at] == '=';
}

/// A word of the language where the line makes sense only with a name: `heading = 90`.
std::optional<Span> word_for_name(const Program& program, Reason reason, Span found) {
  const std::string_view text = program.text;
  const auto kind = find_word(program.text_of(found)).kind;
  if (reason == Reason::ExpectedExpression && kind == WordKind::Statement)
    return begins_line(text, found.begin) || text.substr(found.end).starts_with('(')
               ? std::nullopt
               : std::optional(found);
  if (reason == Reason::NotAStatement && kind != WordKind::Name)
    return assigns(text, text.find_first_not_of(" \t", found.end)) ? std::optional(found)
                                                                   : std::nullopt;
  if (!assigns(text, found.begin))
    return std::nullopt;
  const auto word = word_before(text, found.begin);
  const auto before = find_word(program.text_of(word)).kind;
  if (before != WordKind::Statement && before != WordKind::Keyword)
    return std::nullopt;
  return word;
}

bool is_foreign(char c) {
  return static_cast<unsigned char>(c) >= 0x80;
}

/// What typing and copying bring in place of `"` and of letters.
Diagnostic foreign_character(const Program& program, Span found) {
  const std::string_view text = program.text;
  const auto sign = program.text_of(found);
  for (const std::string_view quote : {"“", "”", "„", "«", "»"})
    if (sign.starts_with(quote))
      return finding(rules::MalformedLine, found, texts::NoQuotationMark(sign), texts::UseQuotes());
  const auto is_part = [&](std::uint32_t at) {
    return is_name_char(text[at]) || is_foreign(text[at]);
  };
  auto word = found;
  while (word.begin > 0 && is_part(word.begin - 1))
    --word.begin;
  while (word.end < text.size() && is_part(word.end))
    ++word.end;
  return finding(rules::MalformedLine, word, texts::NotAName(program.text_of(word), sign),
                 texts::NamesConsistOf());
}

Diagnostic reserved(const Program& program, Span word) {
  const auto first = first_word(program.text, word.begin);
  const char before = sign_before(program.text, word.begin);
  const bool declares = equal_words(first, "sub") || equal_words(first, "function");
  const auto behind = program.text.find_first_not_of(" \t+-*/%", word.end);
  const bool names = declares || holds("const array local for read input next", first) ||
                     (behind != std::string::npos && program.text[behind] == '=');
  const auto text = program.text_of(word);
  return finding(rules::ReservedName, word, texts::Reserved(text),
                 ((before == '(' || before == ',') && !declares) || !names
                     ? texts::ReservedNoValue()
                     : texts::WriteOnAll(fmt::format("my_{}", text)));
}

/// How a call of a function is written whose argument lacks its parentheses.
Message call_of(std::string_view function, std::string_view argument) {
  const bool known = !argument.empty() && is_name_char(argument.front());
  return texts::WriteLike(fmt::format("{}({})", function, known ? argument : "e"));
}

/// The robot's variables that a program can set.
Message settable() {
  std::string all;
  for (const auto& row : spec::variables)
    if (row.access == spec::Access::ReadWrite)
      all += fmt::format("{}`{}`", all.empty() ? "" : ", ", row.word);
  return texts::OnlyTheseSet(std::move(all));
}

/// A sensor that is set. Where other lines read it, too, a variable was meant.
Diagnostic read_only(const Program& program, Span found) {
  const auto sensor = program.text_of(found);
  auto d = finding(rules::WrongUse, found, compiler::texts::CanOnlyBeRead(sensor), settable());
  for (const auto* set : {"yaw", "xpos", "ypos"})
    if (equal_words(sensor, set))
      return d; // by a statement
  constexpr std::size_t most = 64;
  if (program.diagnostics.size() > most)
    return d; // nobody reads that far
  const auto name = fmt::format("my_{}", sensor);
  const auto size_of_all = static_cast<std::uint32_t>(program.text.size());
  const auto file =
      program.files.empty() ? File{{}, {}, 0, size_of_all, 0, 0} : program.file_at(found.begin);
  std::vector<Edit> edits;
  for (auto begin = file.begin; begin < file.end;) {
    const auto rest = std::string_view(program.text).substr(begin, file.end - begin);
    const auto size = std::min(rest.find_first_of("\r\n"), rest.size());
    for (const auto& token :
         repair::split(rest.substr(0, size), repair::Language::Structured).tokens)
      if (token.is_word() && equal_words(token.text, sensor))
        edits.push_back(
            {{begin + token.at, begin + token.at + static_cast<std::uint32_t>(sensor.size())},
             name});
    begin += static_cast<std::uint32_t>(size) + 1;
  }
  if (edits.size() < 2)
    return d;
  d.help = texts::BallMeasures(sensor, name);
  d.fix = Fix{texts::CallIt(name), std::move(edits), Safety::Unsafe};
  return d;
}

Diagnostic bad_number(Span found, std::string_view text) {
  if (text.starts_with('#'))
    return finding(rules::BadNumber, found, texts::NotAColour(text), texts::SixDigits());
  const bool hex = text.size() > 2 && to_lower(text[1]) == 'x' &&
                   text.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string_view::npos;
  if (hex || std::all_of(text.begin(), text.end(), is_digit))
    return finding(rules::BadNumber, found,
                   texts::AboveGreatest(text, spec::value_of(spec::Limit::GreatestInteger)));
  return finding(
      rules::BadNumber, found, texts::NotANumber(text),
      texts::NumbersAre(0, spec::value_of(spec::Limit::GreatestInteger), "250ms", "1.5s", "2min"));
}

/// `print 'hello'`.
Diagnostic single_quotes(const Program& program, Span found) {
  const auto inner = program.text_of({found.begin + 1, found.end - 1});
  auto quoted = fmt::format("\"{}\"", inner);
  auto d = finding(rules::ForeignWord, found, texts::StartsComment(), texts::Write(quoted));
  if (inner.find('"') == std::string_view::npos)
    d.fix = Fix{d.help, {Edit{found, std::move(quoted)}}, Safety::Safe};
  return d;
}

/// What stands between a place and the end of its line.
std::string_view rest_of_line(const Program& program, std::uint32_t at) {
  const auto rest = std::string_view(program.text).substr(at);
  return rest.substr(0, rest.find_first_of("\r\n'"));
}

/// How many values stand in the brackets or braces after a place; 0 where none do.
std::size_t list_after(const Program& program, Span found) {
  const auto rest = rest_of_line(program, found.end);
  const auto begin = rest.find_first_of("[{(");
  if (begin == std::string_view::npos)
    return 0;
  return static_cast<std::size_t>(std::count(rest.begin(), rest.end(), ',')) + 1;
}

/// `array a[3, 3]` and `a[1][2] = 5`: how a table is kept in an array.
Diagnostic second_index(const Program& program, Span found) {
  const std::string_view text = program.text;
  const auto bracket = static_cast<std::uint32_t>(text.substr(0, found.begin).find_last_of('['));
  const auto name = program.text_of(word_before(text, bracket));
  const auto sizes = rest_of_line(program, bracket);
  const auto size_at = [&](std::size_t at) {
    at = std::min(sizes.find_first_not_of("[], ", at), sizes.size());
    const auto digits = sizes.substr(at, sizes.find_first_of("], ", at) - at);
    return parse_number<std::int32_t>(digits).value_or(0);
  };
  const auto rows = size_at(0);
  const auto columns = size_at(found.begin - bracket);
  const bool declared =
      equal_words(first_word(text, found.begin), "array") && rows > 0 && columns > 0 &&
      std::int64_t{rows} * columns <= spec::value_of(spec::Limit::IndexedVariables);
  return malformed(program, found, texts::OneIndex(),
                   declared ? texts::TableOf(name, rows * columns, columns)
                            : texts::TableOfThree(name));
}

} // namespace

/// `4.times`: no line number.
bool goes_on_as_word(const Program& program, Span number) {
  const std::string_view text = program.text;
  return number.end < text.size() && text[number.end] == '.';
}

/// A number in front of a line: of a few lines it is a slip, of all another language.
Diagnostic numbered_line(const Program& program, Span found) {
  auto d =
      finding(rules::NumberedLine, found, texts::NoLineNumbers(), texts::TurnsNumbered("orb lift"));
  const std::string_view text = program.text;
  std::size_t numbered = 0;
  std::size_t all = 0;
  for (std::size_t at = 0; at < text.size(); ++all) {
    const auto begin = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    numbered += begin < text.size() && is_digit(text[begin]) ? 1 : 0;
    at = std::min(text.find('\n', begin), text.size() - 1) + 1;
    if (begin == text.size())
      break;
  }
  const auto after = text.find_first_not_of(" \t", found.end);
  if (numbered * 2 > all || after == std::string_view::npos)
    return d;
  const auto end = std::min(text.find_first_of("\r\n", after), text.size());
  d.help = texts::Write(text.substr(after, end - after));
  d.fix = Fix{compiler::texts::RemoveNumber(),
              {{{found.begin, static_cast<std::uint32_t>(after)}, {}}},
              Safety::Unsafe};
  return d;
}

Diagnostic explain(const Program& program, Reason reason, Span found) {
  const auto text = std::string(program.text_of(found));
  if (!text.empty() && is_foreign(text.front()))
    return foreign_character(program, found);
  if (reason == Reason::ExpectedExpression && text == "#")
    return malformed(program, found, texts::ColourNoValue(), texts::ColourAfterRgb());
  const bool other_expected = reason <= Reason::ExpectedParenthesis;
  if (other_expected || reason == Reason::NotAStatement)
    if (auto known = name_foreign(program, found, Stands::Inside))
      return *std::move(known);
  if (const auto word = word_for_name(program, reason, found))
    return reserved(program, *word);
  switch (reason) {
  case Reason::Trailing: return trailing(program, found);
  case Reason::ExpectedStatement: return malformed(program, found, texts::MissingStatement());
  case Reason::ExpectedExpression:
    if (text.starts_with('"'))
      return malformed(program, found, texts::StringNoValue(),
                       texts::StringsOnlyIn("print", "print \"hello\""));
    return missing_value(program, found);
  case Reason::ExpectedPlace:
    return malformed(program, found, texts::Expected(texts::APlace()),
                     text == "(" && equal_words(first_word(program.text, found.begin), "for")
                         ? texts::WriteBlock("for n = 1 to 4", "next n")
                         : Message());
  case Reason::ExpectedName: return malformed(program, found, texts::Expected(texts::AName()));
  case Reason::ExpectedEquals:
    return malformed(program, found, texts::Missing("="),
                     equal_words(first_word(program.text, found.begin), "for")
                         ? texts::Write("for n = 1 to 4")
                         : Message());
  case Reason::ExpectedThen:
    return malformed(program, found, texts::Missing("then"), texts::ThenOnItsOwn());
  case Reason::ExpectedTo: return malformed(program, found, texts::Missing("to"));
  case Reason::ExpectedComma: return malformed(program, found, texts::TooFewValues());
  case Reason::ExpectedBracket:
    return malformed(program, found, texts::MissingBracket(),
                     text == "(" ? texts::SizeInBrackets()
                     : text == "=" && list_after(program, found) > 0
                         ? texts::SetEachOf(program.text_of(word_before(program.text, found.begin)),
                                            list_after(program, found))
                     : equal_words(first_word(program.text, found.begin), "dim")
                         ? texts::NoDeclaration()
                         : Message());
  case Reason::ExpectedParenthesis:
    if (const auto word = first_word(program.text, found.begin);
        text == "," && find_word(word).kind == WordKind::Statement)
      return finding(rules::MalformedLine, found, texts::NoParentheses(word),
                     texts::RemoveParentheses());
    return malformed(program, found, texts::MissingParenthesis());
  case Reason::ExpectedOperand:
    return malformed(program, found, texts::ArgumentInParentheses(),
                     call_of(program.text_of(word_before(program.text, found.begin)), text));
  case Reason::ExpectedOne:
    return finding(rules::ArgumentCount, found, texts::TakesOneValue(text),
                   texts::WriteLike(text + "(e)"));
  case Reason::ExpectedTwo:
    return finding(rules::ArgumentCount, found, texts::TakesTwoValues(text),
                   texts::WriteLike(text + "(a, b)"));
  case Reason::ExpectedQuote:
    return finding(rules::MalformedLine, found, compiler::texts::UnterminatedString());
  case Reason::ExpectedFile: return malformed(program, found, texts::Expected(texts::AFile()));
  case Reason::NotAStatement: return finding(rules::MalformedLine, found, texts::Unexpected(text));
  case Reason::NakedArguments: return naked_arguments(program, found);
  case Reason::TooManyArguments:
    return finding(rules::ArgumentCount, found, texts::TooManyValues());
  case Reason::ReadOnly: return read_only(program, found);
  case Reason::Reserved: return reserved(program, found);
  case Reason::NameTooLong:
    return finding(rules::ReservedName, found, texts::NameTooLong(found.size(), longest_name));
  case Reason::BadNumber: return bad_number(found, text);
  case Reason::FractionOfMillisecond:
    return finding(rules::BadNumber, found, texts::NoWholeMilliseconds(text));
  case Reason::TooDeep:
    return finding(rules::NestingDepth, found, texts::BracketsTooDeep(),
                   compiler::texts::ComputeSeparately());
  case Reason::NestedIf:
    return finding(rules::MisplacedStatement, found, texts::IfInOneLine(), texts::InnerIfBelow());
  case Reason::BlockInOneLine:
    return finding(rules::MisplacedStatement, found, texts::NotInOneLine(text),
                   texts::StatementBelow());
  case Reason::LineNumber:
    return std::all_of(text.begin(), text.end(), is_digit) && !goes_on_as_word(program, found)
               ? numbered_line(program, found)
               : finding(rules::MalformedLine, found, texts::Unexpected(text));
  case Reason::Gosub:
    return finding(rules::ForeignWord, found, compiler::texts::ThereIsNo("gosub"),
                   texts::SubInstead());
  case Reason::On:
    return finding(rules::ForeignWord, found, compiler::texts::ThereIsNo("on"),
                   texts::SelectInstead());
  case Reason::SingleQuotes: return single_quotes(program, found);
  case Reason::SecondIndex: return second_index(program, found);
  }
  return finding(rules::MalformedLine, found, texts::SyntaxError());
}

} // namespace orb::structured
