#include "compiler/messages/messages.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "compiler/messages/fault_text.h"
#include "compiler/messages/names.h"
#include "compiler/text/rules.h"
#include "compiler/text/words.h"
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

void set_fix(Diagnostic& diagnostic, Message title, Span span, std::string text, Safety safety) {
  diagnostic.fix = Fix{std::move(title), {Edit{span, std::move(text)}}, safety};
}

/// One fault with the text around it.
class Explainer : public FaultText {
public:
  using FaultText::FaultText;

  Diagnostic explain() const {
    switch (fault_.reason) {
    case Reason::BadNumber:
      return make(rules::LineNumberRange,
                  texts::LineNumberOutside(token(), spec::value_of(spec::Limit::LeastLineNumber),
                                           spec::value_of(spec::Limit::GreatestLineNumber)));
    case Reason::UnknownWord: return unknown_word();
    case Reason::NotAStatement:
      return make(rules::SyntaxError, texts::CannotBeginStatement(token()));
    case Reason::ReadOnly: return read_only();
    case Reason::IndexedParenthesis:
      return make(rules::IndexedParenthesis, texts::NoIndexInParentheses(), texts::SetYEarlier());
    case Reason::ImpliedGoto: {
      auto d = make(rules::ImpliedGoto, texts::NotAStatement(token()),
                    texts::Write(fmt::format("goto {}", token())));
      set_fix(d, texts::InsertGoto(), {fault_.span.begin, fault_.span.begin}, "goto ",
              Safety::Safe);
      return d;
    }
    case Reason::TooDeep:
      return make(rules::ExpressionLevels,
                  texts::FarMoreLevelsThan(spec::value_of(spec::Limit::ExpressionLevels)),
                  texts::ComputeSeparately());
    case Reason::ExpectedExpression: return expected_expression();
    case Reason::ExpectedTarget: return expected_target();
    case Reason::ExpectedThen: return expected_then();
    case Reason::ExpectedRelation: return expected_relation();
    case Reason::ExpectedParenthesis: return expected_parenthesis();
    case Reason::ExpectedComma: return expected_comma();
    case Reason::TooManyArguments: return make(rules::SyntaxError, takes_found_more(), form());
    case Reason::ExpectedEquals: return expected_equals();
    case Reason::ExpectedVariable:
    case Reason::ExpectedUserVariable: return expected(texts::AVariable());
    case Reason::ExpectedTo: return expected_code("to");
    case Reason::ExpectedGotoOrGosub: return found_instead(texts::ExpectedEither("goto", "gosub"));
    case Reason::Trailing: return trailing();
    case Reason::NestedIf:
      return make(rules::NestedIf, texts::CannotBeNested("if"), texts::JoinComparisons("and"));
    case Reason::ExpectedQuote:
      return make(rules::SyntaxError, texts::UnterminatedString(), texts::AddQuote());
    case Reason::MissingNumber: // never here: said of all lines at once (lint/lint_numbers.cpp)
    case Reason::ExpectedStatement: break;
    }
    return expected(texts::AStatement());
  }

private:
  std::string_view word() const { return spec::info(fault_.statement).word; }

  Diagnostic make(const Rule& rule, Message message, Message help = {}) const {
    return make_at(rule, fault_.span, std::move(message), std::move(help));
  }
  Diagnostic make_at(const Rule& rule, Span span, Message message, Message help = {}) const {
    return finding(rule, span, std::move(message), std::move(help));
  }

  /// What was wanted, and what stands there.
  Message with_found(Message problem) const {
    return token().empty() ? texts::FoundEnd(std::move(problem))
                           : texts::Found(std::move(problem), token());
  }

  Diagnostic found_instead(Message problem, Message help = {}) const {
    return make(rules::SyntaxError, with_found(std::move(problem)), std::move(help));
  }
  Diagnostic expected(Message what, Message help = {}) const {
    return found_instead(texts::Expected(std::move(what)), std::move(help));
  }
  Diagnostic expected_code(std::string_view text) const {
    return found_instead(texts::ExpectedCode(text));
  }

  /// How many values the statement takes.
  Message takes_found_more() const {
    const auto& row = spec::info(fault_.statement);
    const auto most = row.parameters().size();
    if (row.required < most)
      return texts::TakesEitherFoundMore(row.word, row.required, most);
    return most == 1 ? texts::TakesOneFoundMore(row.word) : texts::TakesFoundMore(row.word, most);
  }
  Message takes_found_less() const {
    const auto& row = spec::info(fault_.statement);
    const auto most = row.parameters().size();
    if (row.required < most)
      return texts::TakesEitherFound(row.word, row.required, most, fault_.found);
    return most == 1 ? texts::TakesOneFound(row.word, fault_.found)
                     : texts::TakesFound(row.word, most, fault_.found);
  }

  Diagnostic unknown_word() const {
    const auto name = token();
    if (equal_words(name, "rem"))
      return make(rules::Rem, texts::NotAStatement(name), texts::Write('\''));
    if (after(fault_.span.end) == '=')
      return unknown_variable(name);
    const auto words = statement_words();
    auto best = closest(name, words);
    if (best && !equal_words(*best, name) && repair::is_known_word(name, repair::Where::Line))
      best.reset(); // what people write elsewhere is not misspelt: `wend`
    if (best && equal_words(*best, name))
      return make(rules::UnknownStatement, texts::NotAStatementCase(name), texts::Write(*best));
    for (const auto prefix : words)
      if (name.starts_with(prefix) &&
          find_word(name.substr(prefix.size())).kind != WordKind::Unknown) {
        auto d =
            make(rules::UnknownStatement, texts::NotAStatement(name), texts::AddSpaceAfter(prefix));
        const auto at = fault_.span.begin + static_cast<std::uint32_t>(prefix.size());
        set_fix(d, d.help, {at, at}, " ", Safety::Safe);
        return d;
      }
    auto d = make(rules::UnknownStatement, texts::NotAStatement(name));
    if (best) {
      d.help = texts::DidYouMean(*best);
      set_fix(d, texts::Write(*best), fault_.span, *best, Safety::Unsafe);
      if (is_slip_of_the_hand(name, *best))
        offer(d, d.fix->title, {{fault_.span, *best}});
    }
    return d;
  }

  /// A long word that begins right and has no other neighbour among the statements: nothing else
  /// can have been meant if the line parses with it.
  static bool is_slip_of_the_hand(std::string_view name, std::string_view best) {
    constexpr std::size_t least = 4;
    auto others = statement_words();
    std::erase(others, best);
    return name.size() >= least && equal_words(name.substr(0, 1), best.substr(0, 1)) &&
           !closest(name, others);
  }

  /// `name = …`: a variable that does not exist.
  Diagnostic unknown_variable(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const auto& row : spec::variables)
      if (row.access == spec::Access::ReadWrite)
        names.push_back(row.word);
    auto d = make(rules::UnknownStatement, texts::NotAVariable(name), texts::VariablesAreNamed());
    if (const auto best = closest(name, names)) {
      const bool same = equal_words(*best, name);
      d.help = same ? texts::WriteBecause(*best, texts::CaseSensitive())
                    : texts::DidYouMeanVariable(*best);
      set_fix(d, texts::Write(*best), fault_.span, *best, same ? Safety::Safe : Safety::Unsafe);
    }
    return d;
  }

  Diagnostic read_only() const {
    auto d = make(rules::AssignToSensor, texts::CanOnlyBeRead(token()));
    const auto variable = spec::find_variable(token());
    if (variable == spec::Variable::Xpos || variable == spec::Variable::Ypos)
      d.help = texts::SetPositionWith("locate x,y");
    else if (variable == spec::Variable::Yaw)
      d.help = texts::SetHeadingWith("heading h");
    else if (variable == spec::Variable::Speed)
      d.help = texts::DriveWith("goroll heading,speed,1");
    return d;
  }

  Diagnostic expected_expression() const {
    const auto begin = fault_.span.begin;
    if (!token().empty() && is_relation(token()[0])) {
      auto from = begin;
      while (from > line_.span.begin && is_blank(text_[from - 1]))
        --from;
      if (from > line_.span.begin && is_relation(text_[from - 1]))
        return bad_operator({from - 1, fault_.span.end});
    }
    const auto& row = spec::info(fault_.statement);
    if (row.form == spec::Form::Arguments && token().empty() && !row.parameters().empty())
      return make(rules::SyntaxError, takes_found_less(), form());
    if (!token().empty() && token()[0] == '"')
      return expected(texts::ANumberOrVariable(), texts::StringsCanBePrinted());
    if (token() == ".")
      return unsupported_number();
    if (!token().empty() && is_letter(token()[0]))
      return unknown_name();
    return expected(texts::AnExpression());
  }

  /// A word inside of an expression that means nothing there.
  Diagnostic unknown_name() const {
    const auto name = token();
    if (find_word(name).kind != WordKind::Unknown)
      return expected(texts::AnExpression());
    std::vector<std::string_view> names;
    for (const auto& row : spec::variables)
      names.push_back(row.word);
    for (const auto& row : spec::functions)
      names.push_back(row.word);
    auto d =
        make(rules::SyntaxError, texts::NeitherVariableNorFunction(name), texts::VariablesAreNamed());
    if (const auto best = closest(name, names)) {
      const bool same = equal_words(*best, name);
      d.help = same ? texts::WriteBecause(*best, texts::CaseSensitive()) : texts::DidYouMean(*best);
      if (!same)
        set_fix(d, texts::Write(*best), fault_.span, *best, Safety::Unsafe);
    }
    return d;
  }

  Diagnostic bad_operator(Span span) const {
    std::string op;
    for (const char c : program_.text_of(span))
      if (!is_blank(c))
        op += c;
    auto d = make_at(rules::BadOperator, span, texts::NotAnOperator(op));
    if (op == "<>" || op == "!=" || op == "><") {
      d.help = texts::Write('!');
      set_fix(d, d.help, span, "!", Safety::Safe);
    } else if (op == "==") {
      d.help = texts::Write('=');
      set_fix(d, d.help, span, "=", Safety::Safe);
    } else if (op == "<=" || op == "=<") {
      or_equal(d, span, '<', +1);
    } else if (op == ">=" || op == "=>") {
      or_equal(d, span, '>', -1);
    }
    return d;
  }

  /// `A <= 5` is `A < 6`; `A <= B` is `A < B + 1` unless B is the greatest number; more than a
  /// number or a variable on the right is not rewritten.
  void or_equal(Diagnostic& d, Span span, char sign, int step) const {
    auto begin = span.end;
    while (begin < line_.span.end && is_blank(text_[begin]))
      ++begin;
    auto end = begin;
    while (end < line_.span.end && is_digit(text_[end]))
      ++end;
    const char add = step > 0 ? '+' : '-';
    d.help = texts::IntegersWriteFor(fmt::format("A {} B {} 1", sign, add),
                                     fmt::format("A {}= B", sign));
    if (const auto name = word_at(begin); name.size() > 0 && ends_comparison(name.end)) {
      const auto changed = fmt::format("{} {} {} 1", sign, program_.text_of(name), add);
      d.help = texts::IntegersWrite(changed);
      set_fix(d, texts::Write(changed), {span.begin, name.end}, changed, Safety::Unsafe);
      return;
    }
    const auto value = parse_number<std::int32_t>(text_.substr(begin, end - begin));
    if (!value || !ends_comparison(end) ||
        (step > 0 && *value == spec::value_of(spec::Limit::GreatestInteger)))
      return;
    // Older robots have no negative numbers.
    const auto other = *value + step < 0 ? std::string("0 - 1") : std::to_string(*value + step);
    const auto changed = fmt::format("{} {}", sign, other);
    d.help = texts::IntegersWrite(changed);
    d.fix = Fix{texts::Write(changed),
                {Edit{span, std::string(1, sign)}, Edit{{begin, end}, other}},
                Safety::Safe};
  }

  /// Whether nothing, a comment or a word (`then`, `and`) follows.
  bool ends_comparison(std::uint32_t offset) const {
    const char next = after(offset);
    return next == '\0' || next == '\'' || is_letter(next);
  }

  Diagnostic expected_target() const {
    if (token().empty())
      return expected(texts::ALineNumber());
    return non_literal();
  }

  Diagnostic non_literal() const {
    auto d = make(rules::NonLiteralTarget, with_found(texts::TakesPlainLineNumber(word())),
                  is_letter(token()[0]) && token().size() > 1
                      ? texts::JumpByNumber(fmt::format("{} 100", word()))
                      : texts::ToChooseUse("on A goto 100,200"));
    const auto number =
        fault_.statement == spec::Statement::Gosub && is_letter(token()[0]) ? only_subroutine() : 0;
    if (number > 0 && skip_blanks(fault_.span.end) == code_end()) {
      d.help = texts::Write(
          fmt::format("{}{}", program_.text_of({line_.span.begin, fault_.span.begin}), number));
      set_fix(d, d.help, fault_.span, std::to_string(number), Safety::Unsafe);
    }
    return d;
  }

  /// The number of the only subroutine that nothing calls: it stands below what does not go on
  /// there, and ends with `return`. 0 where there is none, or another one.
  std::uint32_t only_subroutine() const {
    std::uint32_t only = 0;
    std::uint32_t begin = 0; // of what may be one
    bool falls = true;
    for (const auto& line : program_.lines) {
      if (!line.has_number() || !line.has_statement())
        continue;
      const auto& statement = program_.statements[line.statement];
      begin = falls ? begin : line.number;
      falls = statement.error || (statement.kind != spec::Statement::End &&
                                  statement.kind != spec::Statement::Return &&
                                  statement.kind != spec::Statement::Goto);
      if (statement.error || statement.kind != spec::Statement::Return || begin == 0 ||
          is_target(begin))
        continue;
      if (only != 0)
        return 0;
      only = begin;
    }
    return only;
  }

  bool is_target(std::uint32_t number) const {
    return std::any_of(program_.items.begin(), program_.items.end(), [&](const Item& item) {
      return item.kind == ItemKind::Target && item.value == number;
    });
  }

  Diagnostic expected_then() const {
    if (token() == "and" || token() == "or")
      return make(rules::TooManyRelations, texts::AtMostTwoComparisons(), texts::PutThirdInIf());
    if (token().size() > 1 && is_relation(token()[0]))
      return bad_operator(fault_.span);
    return expected_code("then");
  }

  Diagnostic expected_relation() const {
    if (fault_.statement == spec::Statement::If &&
        (token() == "then" || token() == "and" || token() == "or" || token().empty())) {
      auto d = make(rules::BareCondition, texts::ConditionIsNoComparison(),
                    texts::CompareWithZeroLike("! 0"));
      const auto at = skip_back(fault_.span.begin);
      auto begin = at;
      while (begin > line_.span.begin && is_letter(text_[begin - 1]))
        --begin;
      if (begin < at)
        d.help = texts::CompareWithZeroLike(fmt::format("{} ! 0", text_.substr(begin, at - begin)));
      if (!token().empty() && at < fault_.span.begin)
        set_fix(d, texts::CompareWithZero(), {at, at}, " ! 0", Safety::Safe);
      return d;
    }
    return found_instead(texts::ExpectedComparison('=', '!', '<', '>'));
  }

  Diagnostic expected_parenthesis() const {
    if (!token().empty() && is_relation(token()[0]))
      return fault_.statement == spec::Statement::If
                 ? make(rules::ParenthesizedRelation, texts::ComparisonInParentheses(),
                        texts::RemoveParentheses("if A > 1 and B < 2 then"))
                 : make(rules::SyntaxError, texts::ComparisonsOnlyInIf());
    if (token() == ".")
      return unsupported_number();
    return expected_code(")");
  }

  Diagnostic expected_comma() const {
    const auto& row = spec::info(fault_.statement);
    if (row.form == spec::Form::Arguments && (token().empty() || token() == "else"))
      return make(rules::SyntaxError, takes_found_less(), form());
    if (token() == ".")
      return unsupported_number();
    return expected_code(",");
  }

  Diagnostic expected_equals() const {
    if (token().size() > 1 && token()[0] == '=')
      return bad_operator(fault_.span);
    return expected_code("=");
  }

  Diagnostic unsupported_number() const {
    auto begin = fault_.span.begin;
    while (begin > line_.span.begin && is_digit(text_[begin - 1]))
      --begin;
    auto end = fault_.span.end;
    while (end < line_.span.end && (is_digit(text_[end]) || is_letter(text_[end])))
      ++end;
    const Span span{begin, end};
    return make_at(rules::UnsupportedNumber, span,
                   texts::NotADecimalInteger(program_.text_of(span)), texts::OnlyIntegers());
  }

  Diagnostic trailing() const {
    const auto here = token();
    const char last = before(fault_.span.begin);
    if (here.empty())
      return expected(texts::TheEndOfTheLine());
    if (here == "." ||
        ((here[0] == 'x' || here[0] == 'X') && last == '0' && text_[fault_.span.begin - 1] == '0'))
      return unsupported_number();
    if (!here.empty() && is_relation(here[0])) {
      if (here.size() > 1)
        return bad_operator(fault_.span);
      return make(rules::SyntaxError, texts::ComparisonsOnlyInIf());
    }
    const bool branches = spec::info(fault_.statement).form == spec::Form::Branch ||
                          fault_.statement == spec::Statement::On;
    if (branches && spec::find_operator(here[0]))
      return non_literal();
    if (fault_.statement == spec::Statement::Print && is_letter(here[0]) &&
        find_word(here).kind == WordKind::Unknown)
      return unknown_name();
    return make(rules::SyntaxError, fault_.statement == spec::Statement::Let
                                        ? texts::UnexpectedAfterAssignment(here)
                                        : texts::UnexpectedAfterStatement(here, word()));
  }
};

} // namespace

std::optional<Diagnostic> explain(const Program& program, const Fault& fault) {
  if (auto named = explain_name(program, fault))
    return named;
  if (fault.reason == Reason::MissingNumber)
    return std::nullopt;
  return Explainer(program, fault).explain();
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
