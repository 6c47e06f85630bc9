#include "compiler/messages/messages.h"

#include "base/fixes.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "compiler/text/basic_words.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "repair/idioms.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace orb::compiler {
namespace {

bool is_relation(char c) {
  return spec::find_relation(c).has_value();
}

std::vector<std::string_view> statement_words() {
  std::vector<std::string_view> all;
  for (const auto& row : spec::statements)
    all.push_back(row.word);
  return all;
}

/// The names of variables that can be assigned, or of all that can be read, with functions.
std::vector<std::string_view> names(spec::Access access) {
  std::vector<std::string_view> all;
  for (const auto& row : spec::variables)
    if (access == spec::Access::Read || row.access == access)
      all.push_back(row.word);
  for (const auto& row : spec::functions)
    if (access == spec::Access::Read)
      all.push_back(row.word);
  return all;
}

/// Explains one fault from the text around it.
class Explainer {
public:
  Explainer(const Program& program, const Fault& fault)
      : program_(program), fault_(fault), text_(program.text), line_(program.lines[fault.line]),
        token_(program.text_of(fault.span)) {}

  Diagnostic explain() const {
    if (text_.substr(fault_.span.begin).starts_with("\xC2\xA0"))
      return finding(rules::SyntaxError, {fault_.span.begin, fault_.span.begin + 2},
                     texts::NoBreakSpace());
    switch (fault_.reason) {
    case Reason::BadNumber:
      return make(rules::LineNumberRange,
                  texts::LineNumberOutside(token_, spec::value_of(spec::Limit::LeastLineNumber),
                                           spec::value_of(spec::Limit::GreatestLineNumber)));
    case Reason::UnknownWord: return unknown_word();
    case Reason::NotAStatement:
      return make(rules::SyntaxError, texts::CannotBeginStatement(token_));
    case Reason::ReadOnly:
      return make(rules::AssignToSensor, texts::CanOnlyBeRead(token_), set_otherwise());
    case Reason::IndexedParenthesis:
      return make(rules::IndexedParenthesis, texts::NoIndexInParentheses(), texts::SetYEarlier());
    case Reason::ImpliedGoto: return make(rules::ImpliedGoto, texts::NotAStatement(token_));
    case Reason::TooDeep:
      return make(rules::ExpressionLevels,
                  texts::FarMoreLevelsThan(spec::value_of(spec::Limit::ExpressionLevels)),
                  texts::ComputeSeparately());
    case Reason::ExpectedExpression: return expected_expression();
    case Reason::ExpectedTarget:
      return token_.empty() ? expected(texts::ALineNumber()) : non_literal();
    case Reason::ExpectedThen:
      if (token_ == "and" || token_ == "or")
        return make(rules::TooManyRelations, texts::AtMostTwoComparisons(), texts::PutThirdInIf());
      return token_.size() > 1 && is_relation(token_[0]) ? bad_operator(fault_.span)
                                                         : expected_code("then");
    case Reason::ExpectedRelation: return expected_relation();
    case Reason::ExpectedParenthesis: return expected_parenthesis();
    case Reason::ExpectedComma:
      return lacks_values()  ? takes(fault_.found)
             : token_ == "." ? not_whole()
                             : expected_code(",");
    case Reason::TooManyArguments: return takes(std::nullopt);
    case Reason::ExpectedEquals:
      return token_.size() > 1 && token_[0] == '=' ? bad_operator(fault_.span) : expected_code("=");
    case Reason::ExpectedVariable:
    case Reason::ExpectedUserVariable: return expected(texts::AVariable());
    case Reason::ExpectedTo: return expected_code("to");
    case Reason::ExpectedGotoOrGosub: return found(texts::ExpectedEither("goto", "gosub"));
    case Reason::Trailing: return trailing();
    case Reason::NestedIf:
      return make(rules::NestedIf, texts::CannotBeNested("if"), texts::JoinComparisons("and"));
    case Reason::ExpectedQuote:
      return make(rules::SyntaxError, texts::UnterminatedString(), texts::AddQuote());
    case Reason::MissingNumber: // cannot occur here: one finding for all lines
                                // (lint/lint_numbers.cpp)
    case Reason::ExpectedStatement: break;
    }
    return token_ == ":" ? colon() : expected(texts::AStatement());
  }

private:
  const spec::StatementInfo& row() const { return spec::info(fault_.statement); }

  Diagnostic make(const Rule& rule, Message message, Message help = {}) const {
    return finding(rule, fault_.span, std::move(message), std::move(help));
  }
  /// Says what was expected and what was found.
  Diagnostic found(Message problem) const {
    return make(rules::SyntaxError, token_.empty() ? texts::FoundEnd(std::move(problem))
                                                   : texts::Found(std::move(problem), token_));
  }
  Diagnostic expected(Message what) const { return found(texts::Expected(std::move(what))); }
  Diagnostic expected_code(std::string_view text) const { return found(texts::ExpectedCode(text)); }

  /// The start of the run of characters before `offset` that satisfy `is`.
  template <typename Is>
  std::uint32_t back(std::uint32_t offset, Is is) const {
    while (offset > line_.span.begin && is(text_[offset - 1]))
      --offset;
    return offset;
  }

  Diagnostic colon() const {
    return make(rules::Colon, texts::OneStatementPerLine(':'), texts::PutRestOnLine());
  }

  bool lacks_values() const {
    return row().form == spec::Form::Arguments && !row().parameters().empty() &&
           (token_.empty() || token_ == "else");
  }

  /// Reports how many values the statement takes and how many were found; no `count` means more.
  Diagnostic takes(std::optional<std::uint32_t> count) const {
    const auto word = row().word;
    const auto most = row().parameters().size();
    const auto least = row().required;
    auto message = count ? (least < most ? texts::TakesEitherFound(word, least, most, *count)
                            : most == 1  ? texts::TakesOneFound(word, *count)
                                         : texts::TakesFound(word, most, *count))
                         : (least < most ? texts::TakesEitherFoundMore(word, least, most)
                            : most == 1  ? texts::TakesOneFoundMore(word)
                                         : texts::TakesFoundMore(word, most));
    const auto example = row().example;
    return make(rules::SyntaxError, std::move(message),
                texts::WriteLike(example.substr(example.find(' ') + 1)));
  }

  Diagnostic unknown_word() const {
    constexpr std::size_t least = 4;
    if (equal_words(token_, "rem"))
      return make(rules::Rem, texts::NotAStatement(token_), texts::Write('\''));
    auto end = fault_.span.end;
    while (end < line_.span.end &&
           (text_[end] == '_' || is_digit(text_[end]) || is_letter(text_[end])))
      ++end;
    const auto next = text_.find_first_not_of(" \t", end);
    if (next < line_.span.end && text_[next] == '=')
      return finding(rules::UnknownStatement, {fault_.span.begin, end},
                     texts::NotAVariable(program_.text_of({fault_.span.begin, end})),
                     spelled(names(spec::Access::ReadWrite)));
    const auto best = closest(token_, statement_words());
    if (best && equal_words(*best, token_))
      return make(rules::UnknownStatement, texts::NotAStatementCase(token_), texts::Write(*best));
    auto d = make(rules::UnknownStatement, texts::NotAStatement(token_));
    if (best && token_.size() >= least && !repair::is_known_word(token_, repair::Where::Line)) {
      d.help = texts::DidYouMean(*best);
      d.fix = single_fix(texts::Write(*best), fault_.span, std::string(*best), Safety::Unsafe);
    }
    return d;
  }

  /// Says that a name is spelt differently, or how variables are named.
  Message spelled(const std::vector<std::string_view>& known) const {
    const auto best = closest(token_, known);
    return best && equal_words(*best, token_) ? texts::WriteBecause(*best, texts::CaseSensitive())
                                              : texts::VariablesAreNamed();
  }

  Message set_otherwise() const {
    if (token_ == "xpos" || token_ == "ypos")
      return texts::SetPositionWith("locate x,y");
    if (token_ == "yaw")
      return texts::SetHeadingWith("heading h");
    return token_ == "speed" ? texts::DriveWith("goroll heading,speed,1") : Message();
  }

  Diagnostic expected_expression() const {
    if (token_.empty())
      return lacks_values() ? takes(fault_.found) : expected(texts::AnExpression());
    if (is_relation(token_[0]))
      if (const auto from = back(fault_.span.begin, [](char c) { return is_blank(c); });
          from > line_.span.begin && is_relation(text_[from - 1]))
        return bad_operator({from - 1, fault_.span.end});
    if (token_[0] == '"')
      return make(rules::SyntaxError,
                  texts::Found(texts::Expected(texts::ANumberOrVariable()), token_),
                  texts::StringsCanBePrinted());
    if (token_ == ".")
      return not_whole();
    return is_letter(token_[0]) && find_word(token_).kind == WordKind::Unknown
               ? unknown_name()
               : expected(texts::AnExpression());
  }

  /// An unknown word inside an expression.
  Diagnostic unknown_name() const {
    return make(rules::SyntaxError, texts::NeitherVariableNorFunction(token_),
                spelled(names(spec::Access::Read)));
  }

  Diagnostic bad_operator(Span span) const {
    std::string sign(program_.text_of(span));
    std::erase_if(sign, is_blank);
    const bool or_equal = sign == "<=" || sign == "=<" || sign == ">=" || sign == "=>";
    const char bare = sign.find('<') != sign.npos ? '<' : '>';
    return finding(rules::BadOperator, span, texts::NotAnOperator(sign),
                   or_equal ? texts::IntegersWriteFor(
                                  fmt::format("A {} B {} 1", bare, bare == '<' ? '+' : '-'),
                                  fmt::format("A {}= B", bare))
                            : Message());
  }

  Diagnostic non_literal() const {
    return make(rules::NonLiteralTarget,
                texts::Found(texts::TakesPlainLineNumber(row().word), token_),
                is_letter(token_[0]) && token_.size() > 1
                    ? texts::JumpByNumber(fmt::format("{} 100", row().word))
                    : texts::ToChooseUse("on A goto 100,200"));
  }

  Diagnostic expected_relation() const {
    if (fault_.statement != spec::Statement::If ||
        !(token_ == "then" || token_ == "and" || token_ == "or" || token_.empty()))
      return found(texts::ExpectedComparison('=', '!', '<', '>'));
    const auto end = back(fault_.span.begin, [](char c) { return is_blank(c); });
    const auto word = program_.text_of({back(end, [](char c) { return is_letter(c); }), end});
    auto d = make(rules::BareCondition, texts::ConditionIsNoComparison(),
                  texts::CompareWithZeroLike(word.empty() ? "! 0" : fmt::format("{} ! 0", word)));
    if (end < fault_.span.begin && !token_.empty())
      d.fix = single_fix(d.help, {end, end}, " ! 0", Safety::Safe);
    return d;
  }

  Diagnostic expected_parenthesis() const {
    if (!token_.empty() && is_relation(token_[0]))
      return fault_.statement == spec::Statement::If
                 ? make(rules::ParenthesizedRelation, texts::ComparisonInParentheses(),
                        texts::RemoveParentheses("if A > 1 and B < 2 then"))
                 : make(rules::SyntaxError, texts::ComparisonsOnlyInIf());
    return token_ == "." ? not_whole() : expected_code(")");
  }

  /// Reports `1.5` and `0x1F`.
  Diagnostic not_whole() const {
    auto end = fault_.span.end;
    while (end < line_.span.end && (is_digit(text_[end]) || is_letter(text_[end])))
      ++end;
    const Span span{back(fault_.span.begin, [](char c) { return is_digit(c); }), end};
    return finding(rules::UnsupportedNumber, span,
                   texts::NotADecimalInteger(program_.text_of(span)), texts::OnlyIntegers());
  }

  Diagnostic trailing() const {
    if (token_.empty())
      return expected(texts::TheEndOfTheLine());
    if (token_ == ":")
      return colon();
    if (token_ == "." || (to_lower(token_[0]) == 'x' && text_[fault_.span.begin - 1] == '0'))
      return not_whole();
    if (is_relation(token_[0]))
      return token_.size() > 1 ? bad_operator(fault_.span)
                               : make(rules::SyntaxError, texts::ComparisonsOnlyInIf());
    if ((row().form == spec::Form::Branch || fault_.statement == spec::Statement::On) &&
        spec::find_operator(token_[0]))
      return non_literal();
    if (fault_.statement == spec::Statement::Print && is_letter(token_[0]) &&
        find_word(token_).kind == WordKind::Unknown)
      return unknown_name();
    return make(rules::SyntaxError, fault_.statement == spec::Statement::Let
                                        ? texts::UnexpectedAfterAssignment(token_)
                                        : texts::UnexpectedAfterStatement(token_, row().word));
  }

  const Program& program_;
  const Fault& fault_;
  std::string_view text_;
  const Line& line_;
  std::string_view token_;
};

/// A comment in the syntax of another language, alone on its line.
std::optional<Diagnostic> foreign_comment(const Program& program, const Fault& fault) {
  const auto end = program.lines[fault.line].span.end;
  const auto parts =
      repair::split(program.text_of(program.lines[fault.line].span), repair::Language::Basic);
  if (!parts.tokens.empty() || parts.comment.empty())
    return std::nullopt;
  auto d =
      finding(rules::Rem, fault.span, texts::CommentsStartWith('\''), texts::Write(parts.comment));
  d.fix = single_fix(d.help, {fault.span.begin, end}, parts.comment, Safety::Safe);
  return d;
}

} // namespace

std::optional<Diagnostic> explain(const Program& program, const Fault& fault) {
  return fault.reason == Reason::MissingNumber ? foreign_comment(program, fault)
                                               : Explainer(program, fault).explain();
}

bool may_steer(const Program& program, const Fault& fault) {
  auto meant = std::optional(fault.statement);
  if (fault.reason == Reason::UnknownWord) {
    const auto word = closest(program.text_of(fault.span), statement_words());
    meant = word ? spec::find_statement(*word) : std::nullopt;
  }
  if (!meant || fault.reason == Reason::MissingNumber || fault.reason == Reason::BadNumber)
    return true;
  const auto after = spec::info(*meant).after;
  return after != spec::After::Falls && after != spec::After::Waits;
}

} // namespace orb::compiler
