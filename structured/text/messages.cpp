#include "structured/text/messages.h"

#include "base/fixes.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "compiler/text/texts.h"
#include "repair/tokens.h"
#include "spec/limits.h"
#include "structured/text/foreign_words.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

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

/// The character before a place, ignoring whitespace and line endings.
char sign_before(std::string_view text, std::uint32_t at) {
  const auto last = text.substr(0, at).find_last_not_of(" \t\r\n");
  return last == std::string_view::npos ? '\n' : text[last];
}

/// The name or word that ends before a place, ignoring whitespace.
Span word_before(std::string_view text, std::uint32_t at) {
  while (at > 0 && is_blank(text[at - 1]))
    --at;
  auto begin = at;
  while (begin > 0 && is_name_char(text[begin - 1]))
    --begin;
  return {begin, at};
}

bool begins_line(std::string_view text, std::uint32_t at) {
  const auto last = text.substr(0, at).find_last_not_of(" \t");
  return last == std::string_view::npos || is_line_end(text[last]);
}

/// The first word of the line at a place.
std::string_view first_word(std::string_view text, std::uint32_t at) {
  text.remove_prefix(text.substr(0, at).find_last_of("\r\n") + 1);
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  const char* const end = end_of_name(text.data(), text.data() + text.size());
  return {text.data(), static_cast<std::size_t>(end - text.data())};
}

/// A value missing at the end of a line is noticed on the next line, but must be reported where it
/// belongs.
Diagnostic missing_value(const Program& program, Span found) {
  const auto end = program.text.find_last_not_of(" \t\r\n", found.begin - 1);
  const char sign = sign_before(program.text, found.begin);
  if (!begins_line(program.text, found.begin) || sign == '\n' || is_name_char(sign))
    return malformed(program, found, texts::MissingValue());
  const auto at = static_cast<std::uint32_t>(end);
  return finding(rules::MalformedLine, {at, at + 1}, texts::MissingValueAfter(sign));
}

/// True if a line of the text begins a sub or a function of this name.
bool is_sub(std::string_view text, std::string_view name) {
  for (const std::string_view word : {"sub ", "function "})
    for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
      const auto end = at + word.size() + name.size();
      if (begins_line(text, static_cast<std::uint32_t>(at)) && end <= text.size() &&
          equal_words(text.substr(at + word.size(), name.size()), name) &&
          (end == text.size() || !is_name_char(text[end])))
        return true;
    }
  return false;
}

/// Values after a name without parentheses: a misspelt statement, or a call.
Diagnostic naked_arguments(const Program& program, Span found) {
  const auto called = word_before(program.text, found.begin);
  if (auto known = name_foreign(program, called, Stands::First))
    return *std::move(known);
  const auto word = std::string(program.text_of(called));
  const auto sign = std::string_view(program.text).substr(found.begin, 2);
  const auto behind = program.text.find_first_not_of(" \t;", found.begin + 2);
  if (holds("++ --", sign) && is_line_end(program.text[behind]))
    return foreign(program, {found.begin, found.begin + 2}, "C/JavaScript",
                   fmt::format("{}= 1", sign[0]));
  if (program.text[found.begin] == '$')
    return finding(rules::MalformedLine, found, texts::NoDollar(), texts::OnlyIntegers());
  if (spec::find_operator(program.text[found.begin]))
    return malformed(program, found, texts::ValueNoStatement(), texts::SetOrPrint(word));
  std::vector<std::string_view> statements;
  for (const auto& row : spec::statements)
    statements.push_back(row.word);
  if (const auto meant = closest(word, statements); meant && !is_sub(program.text, word))
    return finding(rules::UnknownName, called, texts::NeitherStatementNorSub(word),
                   texts::DidYouMean(*meant));
  return malformed(program, found, texts::CallInParentheses());
}

/// True if `=`, `+=` or the like is at a place.
bool assigns(std::string_view text, std::size_t at) {
  if (at < text.size() && std::string_view("+-*/%").find(text[at]) != std::string_view::npos)
    ++at;
  return at < text.size() && text[at] == '=';
}

/// A reserved word where the line makes sense only with a name: `heading = 90`.
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

/// Characters that typing and copying put in place of `"`, spaces and letters.
Diagnostic foreign_character(const Program& program, Span found) {
  const std::string_view text = program.text;
  const auto sign = program.text_of(found);
  for (const std::string_view quote : {"“", "”", "„", "«", "»"})
    if (sign.starts_with(quote))
      return finding(rules::MalformedLine, found, texts::NoQuotationMark(sign), texts::UseQuotes());
  constexpr std::pair<std::string_view, const orb::Text*> unseen[] = {
      {"\u00A0\u202F", &texts::NoBreakSpace},
      {"\u2002\u2003\u2009\u3000", &texts::SpecialSpace},
      {"\u00AD\u200B\u200C\u200D\u2060\uFEFF", &texts::InvisibleCharacter}};
  for (const auto& [signs, name] : unseen)
    if (sign.size() > 1 && signs.find(sign) != std::string_view::npos && !is_utf8_tail(sign[0]) &&
        (sign.size() > 2 || sign[0] == '\xC2')) {
      const bool blank = name != &texts::InvisibleCharacter;
      auto d = finding(rules::MalformedLine, found, Message(*name, {}),
                       blank ? texts::WriteBlank() : texts::RemoveIt());
      d.fix = single_fix(d.help, found, blank ? " " : "", Safety::Safe);
      return d;
    }
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

/// The robot's variables that a program can assign.
Message settable() {
  std::string all;
  for (const auto& row : spec::variables)
    if (row.access == spec::Access::ReadWrite)
      all += fmt::format("{}`{}`", all.empty() ? "" : ", ", row.word);
  return texts::OnlyTheseSet(std::move(all));
}

/// An assignment to a sensor. If other lines read it, too, a variable was meant.
Diagnostic read_only(const Program& program, Span found) {
  const auto sensor = program.text_of(found);
  auto d = finding(rules::WrongUse, found, compiler::texts::CanOnlyBeRead(sensor), settable());
  for (const auto* set : {"yaw", "xpos", "ypos"})
    if (equal_words(sensor, set))
      return d; // set by a statement
  constexpr std::size_t most = 64;
  if (program.diagnostics.size() > most)
    return d; // a longer list helps nobody
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
    d.fix = single_fix(d.help, found, std::move(quoted), Safety::Safe);
  return d;
}

/// A number at the start of a line: a slip if it is only one line, otherwise another language.
Diagnostic line_number(const Program& program, Span found) {
  const std::string_view text = program.text;
  const auto number = program.text_of(found);
  if (!std::all_of(number.begin(), number.end(), is_digit) ||
      text.substr(found.end).starts_with('.')) // `4.times`
    return finding(rules::MalformedLine, found, texts::NoStatementBegins(number));
  auto d =
      finding(rules::NumberedLine, found, texts::NoLineNumbers(), texts::TurnsNumbered("orb lift"));
  // A slip on a few lines, another language on most.
  std::size_t numbered = 0;
  std::size_t all = 0;
  for (auto begin = text.find_first_not_of(" \t\r\n"); begin < text.size(); ++all) {
    numbered += is_digit(text[begin]) ? 1 : 0;
    begin = text.find_first_not_of(" \t\r\n", std::min(text.find('\n', begin), text.size()));
  }
  const auto after = text.find_first_not_of(" \t", found.end);
  const auto end = std::min(text.find_first_of("\r\n", found.end), text.size());
  if (numbered * 2 > all || after >= end)
    return d;
  d.help = texts::Write(text.substr(after, end - after));
  d.fix = single_fix(compiler::texts::RemoveNumber(),
                     {found.begin, static_cast<std::uint32_t>(after)}, "", Safety::Unsafe);
  return d;
}

// clang-format off

/// Why a line does not parse, by the token where the error shows. The first matching row counts; an
/// empty column matches anything.
struct Cause {
  Reason reason;
  std::string_view found; ///< any of these
  std::string_view first; ///< the first word of the line; `1`: a statement with values
  const Rule* rule; ///< `missing`: a malformed line, also told what stands there instead
  const orb::Text* text;
  std::string_view filler = {}; ///< of its hole, or one of the three below; empty: it has none
  const orb::Text* help = nullptr;
};
constexpr std::string_view found_token = "?";
constexpr std::string_view first_word_of_line = "1";
constexpr std::string_view word_before_it = "0";

using enum Reason;
constexpr const Rule* malformed_line = &rules::MalformedLine;
constexpr const Rule* missing = nullptr;
constexpr auto causes = std::to_array<Cause>({
    {Trailing, "=", "array", malformed_line, &texts::NoInitialValues, {}, &texts::SetEach},
    {Trailing, "+", "print", malformed_line, &texts::NoConcatenation, {}, &texts::PartsSideBySide},
    {Trailing, ":", "", &rules::ForeignWord, &texts::DoesNotSeparate, found_token, &texts::OnePerLine},
    {Trailing, "ms s min", "", malformed_line, &texts::UnitFollows},
    {Trailing, "", "loop", malformed_line, &texts::TakesNoCount, "loop", &texts::RepeatCounts},
    {Trailing, "", "1", malformed_line, &texts::EndsBefore, found_token, &texts::SeparateValues},
    {Trailing, "", "", malformed_line, &texts::EndsBefore, found_token},
    {ExpectedStatement, "", "", missing, &texts::MissingStatement},
    {ExpectedExpression, "#", "", malformed_line, &texts::ColourNoValue, {}, &texts::ColourAfterRgb},
    {ExpectedPlace, "(", "for", &rules::ForeignWord, &texts::ForCounts},
    {ExpectedPlace, "", "", missing, &texts::MissingPlace},
    {ExpectedName, "", "", missing, &texts::MissingName},
    {ExpectedEquals, "", "for", &rules::ForeignWord, &texts::ForCounts},
    {ExpectedEquals, "", "", missing, &texts::Missing, "="},
    {ExpectedThen, "", "", missing, &texts::Missing, "then", &texts::ThenOnItsOwn},
    {ExpectedTo, "", "", missing, &texts::Missing, "to"},
    {ExpectedComma, "", "", malformed_line, &texts::TooFewValues},
    {ExpectedBracket, "( =", "", missing, &texts::MissingBracket, {}, &texts::SizeInBrackets},
    {ExpectedBracket, "", "", missing, &texts::MissingBracket},
    {ExpectedParenthesis, ",", "1", malformed_line, &texts::NoParentheses, first_word_of_line, &texts::RemoveParentheses},
    {ExpectedParenthesis, "", "", missing, &texts::MissingParenthesis},
    {ExpectedOperand, "", "", malformed_line, &texts::ArgumentInParentheses, word_before_it},
    {ExpectedOne, "", "", &rules::ArgumentCount, &texts::TakesOneValue, found_token},
    {ExpectedTwo, "", "", &rules::ArgumentCount, &texts::TakesTwoValues, found_token},
    {ExpectedQuote, "", "", malformed_line, &compiler::texts::UnterminatedString},
    {ExpectedFile, "", "", missing, &texts::MissingPath},
    {NotAStatement, "", "", malformed_line, &texts::NoStatementBegins, found_token},
    {TooManyArguments, "", "", &rules::ArgumentCount, &texts::TooManyValues},
    {FractionOfMillisecond, "", "", &rules::BadNumber, &texts::NoWholeMilliseconds, found_token},
    {TooDeep, "", "", &rules::NestingDepth, &texts::BracketsTooDeep, {}, &compiler::texts::ComputeSeparately},
    {NestedIf, "", "", &rules::MisplacedStatement, &texts::IfInOneLine, {}, &texts::InnerIfBelow},
    {BlockInOneLine, "", "", &rules::MisplacedStatement, &texts::NotInOneLine, found_token, &texts::StatementBelow},
    {Gosub, "", "", &rules::ForeignWord, &compiler::texts::ThereIsNo, found_token, &texts::SubInstead},
    {On, "", "", &rules::ForeignWord, &compiler::texts::ThereIsNo, found_token, &texts::SelectInstead},
    {SecondIndex, "", "", malformed_line, &texts::OneIndex, {}, &texts::TableOf},
});

// clang-format on

/// Finds the row that explains a line; nothing if none matches.
std::optional<Diagnostic> cause_of(const Program& program, Reason reason, Span found) {
  const auto text = program.text_of(found);
  const auto first = first_word(program.text, found.begin);
  const auto word = find_word(first);
  const bool values = word.kind == WordKind::Statement &&
                      spec::statements[word.index].form == spec::Form::Arguments;
  const auto* const row = std::find_if(causes.begin(), causes.end(), [&](const Cause& one) {
    return one.reason == reason && (one.found.empty() || holds(one.found, text)) &&
           (one.first.empty() || (one.first == "1" ? values : equal_words(one.first, first)));
  });
  if (row == causes.end())
    return std::nullopt;
  std::vector<Message> fillers;
  if (!row->filler.empty())
    fillers.push_back(Message::as_is(std::string(
        row->filler == found_token          ? text
        : row->filler == first_word_of_line ? first
        : row->filler == word_before_it ? program.text_of(word_before(program.text, found.begin))
                                        : row->filler)));
  Message said(*row->text, std::move(fillers));
  auto help = row->help == nullptr ? Message() : Message(*row->help, {});
  return row->rule == missing ? malformed(program, found, std::move(said), std::move(help))
                              : finding(*row->rule, found, std::move(said), std::move(help));
}

} // namespace

Diagnostic explain(const Program& program, Reason reason, Span found) {
  const auto text = std::string(program.text_of(found));
  if (!text.empty() && is_foreign(text.front()))
    return foreign_character(program, found);
  if (reason <= ExpectedParenthesis || reason == NotAStatement)
    if (auto known = name_foreign(program, found, Stands::Inside))
      return *std::move(known);
  if (const auto word = word_for_name(program, reason, found))
    return reserved(program, *word);
  const auto first = first_word(program.text, found.begin);
  const char before = sign_before(program.text, found.begin);
  if (reason == Trailing && before == ',' && begins_line(program.text, found.begin))
    return malformed(program, found, texts::CommaContinues(), texts::TrailingSpace());
  if (reason == Trailing && text == "=" && before == ')' && find_word(first).kind == WordKind::Name)
    return malformed(program, found, texts::IndexInBrackets());
  if (auto known = cause_of(program, reason, found))
    return *std::move(known);
  if (reason == ExpectedExpression && text.starts_with('"'))
    return !equal_words(first, "print")
               ? finding(rules::MalformedLine, found, texts::OnlyPrinted(text),
                         texts::StringsOnlyIn("print", "print \"hello\""))
           : before == '(' ? finding(rules::MalformedLine, found, texts::NoParentheses(first),
                                     texts::WriteLike("print \"hello\""))
                           : finding(rules::MalformedLine, found, texts::NoConcatenation(),
                                     texts::PartsSideBySide());
  if (reason == NameTooLong)
    return finding(rules::ReservedName, found, texts::NameTooLong(found.size(), longest_name));
  return reason == NakedArguments ? naked_arguments(program, found)
         : reason == ReadOnly     ? read_only(program, found)
         : reason == Reserved     ? reserved(program, found)
         : reason == BadNumber    ? bad_number(found, text)
         : reason == LineNumber   ? line_number(program, found)
         : reason == SingleQuotes ? single_quotes(program, found)
                                  : missing_value(program, found);
}

} // namespace orb::structured
