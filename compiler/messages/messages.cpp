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

void set_fix(Diagnostic& diagnostic, std::string title, Span span, std::string text,
             Safety safety) {
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
                  fmt::format("line number {} is outside 1 to {}", token(),
                              spec::value_of(spec::Limit::GreatestLineNumber)));
    case Reason::UnknownWord: return unknown_word();
    case Reason::NotAStatement:
      return make(rules::SyntaxError, fmt::format("`{}` cannot begin a statement", token()));
    case Reason::ReadOnly: return read_only();
    case Reason::IndexedParenthesis:
      return make(rules::IndexedParenthesis, "`Z` does not take an index in parentheses",
                  "set `Y` on an earlier line, then use `Z` alone");
    case Reason::ImpliedGoto: {
      auto d = make(rules::ImpliedGoto, fmt::format("`{}` is not a statement", token()),
                    fmt::format("write `goto {}`", token()));
      set_fix(d, "insert `goto`", {fault_.span.begin, fault_.span.begin}, "goto ", Safety::Safe);
      return d;
    }
    case Reason::TooDeep:
      return make(rules::ExpressionLevels,
                  fmt::format("far more than {} nested parentheses and functions",
                              spec::value_of(spec::Limit::ExpressionLevels)),
                  "compute part of it on a separate line");
    case Reason::ExpectedStatement: return expected_statement();
    case Reason::ExpectedExpression: return expected_expression();
    case Reason::ExpectedTarget: return expected_target();
    case Reason::ExpectedThen: return expected_then();
    case Reason::ExpectedRelation: return expected_relation();
    case Reason::ExpectedParenthesis: return expected_parenthesis();
    case Reason::ExpectedComma: return expected_comma();
    case Reason::TooManyArguments:
      return make(rules::SyntaxError, fmt::format("{}, found more", takes()), form());
    case Reason::ExpectedEquals: return expected_equals();
    case Reason::ExpectedVariable:
    case Reason::ExpectedUserVariable: return expected("a variable, A to Z");
    case Reason::ExpectedTo: return expected("`to`");
    case Reason::ExpectedGotoOrGosub: return expected("`goto` or `gosub`");
    case Reason::Trailing: return trailing();
    case Reason::NestedIf:
      return make(rules::NestedIf, "`if` cannot be nested",
                  "join two comparisons with `and`, or write the second on a separate line");
    case Reason::ExpectedQuote:
      return make(rules::SyntaxError, "unterminated string", "add `\"` at the end");
    case Reason::MissingNumber: break; // of all lines at once: lint/lint_numbers.cpp
    }
    return make(rules::SyntaxError, "malformed line");
  }

private:
  std::string_view word() const { return spec::info(fault_.statement).word; }

  Diagnostic make(const Rule& rule, std::string message, std::string help = {}) const {
    return make_at(rule, fault_.span, std::move(message), std::move(help));
  }
  Diagnostic make_at(const Rule& rule, Span span, std::string message,
                     std::string help = {}) const {
    return finding(rule, span, std::move(message), std::move(help));
  }

  std::string found() const {
    return token().empty() ? "the end of the line" : fmt::format("`{}`", token());
  }

  Diagnostic expected(std::string_view what, std::string help = {}) const {
    return make(rules::SyntaxError, fmt::format("expected {}, found {}", what, found()),
                std::move(help));
  }

  /// How many values the statement takes, as a sentence.
  std::string takes() const {
    const auto& row = spec::info(fault_.statement);
    const auto most = row.parameters().size();
    return row.required < most
               ? fmt::format("`{}` takes {} or {} values", row.word, row.required, most)
               : fmt::format("`{}` takes {}", row.word, plural(most, "value"));
  }

  Diagnostic unknown_word() const {
    const auto name = token();
    if (equal_words(name, "rem"))
      return make(rules::Rem, fmt::format("`{}` is not a statement", name), "write `'`");
    if (after(fault_.span.end) == '=')
      return unknown_variable(name);
    const auto words = statement_words();
    auto best = closest(name, words);
    if (best && !equal_words(*best, name) && repair::is_known_word(name, repair::Where::Line))
      best.reset(); // what people write elsewhere is not misspelt: `wend`
    if (best && equal_words(*best, name))
      return make(rules::UnknownStatement,
                  fmt::format("`{}` is not a statement; orbBasic is case-sensitive", name),
                  fmt::format("write `{}`", *best));
    for (const auto prefix : words)
      if (name.starts_with(prefix) &&
          find_word(name.substr(prefix.size())).kind != WordKind::Unknown) {
        auto d = make(rules::UnknownStatement, fmt::format("`{}` is not a statement", name),
                      fmt::format("add a space after `{}`", prefix));
        const auto at = fault_.span.begin + static_cast<std::uint32_t>(prefix.size());
        set_fix(d, d.help, {at, at}, " ", Safety::Safe);
        return d;
      }
    auto d = make(rules::UnknownStatement, fmt::format("`{}` is not a statement", name));
    if (best) {
      d.help = fmt::format("did you mean `{}`?", *best);
      set_fix(d, fmt::format("write `{}`", *best), fault_.span, *best, Safety::Unsafe);
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
    auto d = make(rules::UnknownStatement, fmt::format("`{}` is not a variable", name),
                  "variables are named A to Z");
    if (const auto best = closest(name, names)) {
      const bool same = equal_words(*best, name);
      d.help = same ? fmt::format("write `{}`; orbBasic is case-sensitive", *best)
                    : fmt::format("did you mean `{}`? variables are named A to Z", *best);
      set_fix(d, fmt::format("write `{}`", *best), fault_.span, *best,
              same ? Safety::Safe : Safety::Unsafe);
    }
    return d;
  }

  Diagnostic read_only() const {
    auto d = make(rules::AssignToSensor, fmt::format("`{}` can only be read", token()));
    const auto variable = spec::find_variable(token());
    if (variable == spec::Variable::Xpos || variable == spec::Variable::Ypos)
      d.help = "set the position with `locate x,y`";
    else if (variable == spec::Variable::Yaw)
      d.help = "set the heading with `heading h`";
    else if (variable == spec::Variable::Speed)
      d.help = "drive with `goroll heading,speed,1`";
    return d;
  }

  Diagnostic expected_statement() const { return expected("a statement"); }

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
      return make(rules::SyntaxError, fmt::format("{}, found {}", takes(), fault_.found), form());
    if (!token().empty() && token()[0] == '"')
      return expected("a number or a variable", "strings can only be printed");
    if (token() == ".")
      return unsupported_number();
    if (!token().empty() && is_letter(token()[0]))
      return unknown_name();
    return expected("a number, a variable or an expression");
  }

  /// A word inside of an expression that means nothing there.
  Diagnostic unknown_name() const {
    const auto name = token();
    if (find_word(name).kind != WordKind::Unknown)
      return expected("a number, a variable or an expression");
    std::vector<std::string_view> names;
    for (const auto& row : spec::variables)
      names.push_back(row.word);
    for (const auto& row : spec::functions)
      names.push_back(row.word);
    auto d =
        make(rules::SyntaxError, fmt::format("`{}` is neither a variable nor a function", name),
             "variables are named A to Z");
    if (const auto best = closest(name, names)) {
      const bool same = equal_words(*best, name);
      d.help = same ? fmt::format("write `{}`; orbBasic is case-sensitive", *best)
                    : fmt::format("did you mean `{}`?", *best);
      if (!same)
        set_fix(d, fmt::format("write `{}`", *best), fault_.span, *best, Safety::Unsafe);
    }
    return d;
  }

  Diagnostic bad_operator(Span span) const {
    std::string op;
    for (const char c : program_.text_of(span))
      if (!is_blank(c))
        op += c;
    auto d = make_at(rules::BadOperator, span, fmt::format("`{}` is not an operator", op));
    if (op == "<>" || op == "!=" || op == "><") {
      d.help = "write `!`";
      set_fix(d, d.help, span, "!", Safety::Safe);
    } else if (op == "==") {
      d.help = "write `=`";
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
    d.help = fmt::format("values are integers: write `A {} B {} 1` for `A {}= B`", sign,
                         step > 0 ? '+' : '-', sign);
    if (const auto name = word_at(begin); name.size() > 0 && ends_comparison(name.end)) {
      const auto changed =
          fmt::format("{} {} {} 1", sign, program_.text_of(name), step > 0 ? '+' : '-');
      d.help = fmt::format("values are integers: write `{}`", changed);
      set_fix(d, fmt::format("write `{}`", changed), {span.begin, name.end}, changed,
              Safety::Unsafe);
      return;
    }
    const auto value = parse_number<std::int32_t>(text_.substr(begin, end - begin));
    if (!value || !ends_comparison(end) ||
        (step > 0 && *value == spec::value_of(spec::Limit::GreatestInteger)))
      return;
    // Older robots have no negative numbers.
    const auto other = *value + step < 0 ? std::string("0 - 1") : std::to_string(*value + step);
    d.help = fmt::format("values are integers: write `{} {}`", sign, other);
    d.fix = Fix{fmt::format("write `{} {}`", sign, other),
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
      return expected("a line number");
    return non_literal();
  }

  Diagnostic non_literal() const {
    auto d = make(rules::NonLiteralTarget,
                  fmt::format("`{}` takes a plain line number, found {}", word(), found()),
                  is_letter(token()[0]) && token().size() > 1
                      ? fmt::format("jump to a line by its number: `{} 100`", word())
                      : "to choose between lines, use `on A goto 100,200`");
    const auto number =
        fault_.statement == spec::Statement::Gosub && is_letter(token()[0]) ? only_subroutine() : 0;
    if (number > 0 && skip_blanks(fault_.span.end) == code_end()) {
      d.help = fmt::format("write `{}{}`", program_.text_of({line_.span.begin, fault_.span.begin}),
                           number);
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
      return make(rules::TooManyRelations, "`if` takes at most two comparisons",
                  "put the third in a separate `if`");
    if (token().size() > 1 && is_relation(token()[0]))
      return bad_operator(fault_.span);
    return expected("`then`");
  }

  Diagnostic expected_relation() const {
    if (fault_.statement == spec::Statement::If &&
        (token() == "then" || token() == "and" || token() == "or" || token().empty())) {
      auto d = make(rules::BareCondition, "the condition is not a comparison",
                    "compare with zero: `! 0`");
      const auto at = skip_back(fault_.span.begin);
      auto begin = at;
      while (begin > line_.span.begin && is_letter(text_[begin - 1]))
        --begin;
      if (begin < at)
        d.help = fmt::format("compare with zero: `{} ! 0`", text_.substr(begin, at - begin));
      if (!token().empty() && at < fault_.span.begin)
        set_fix(d, "compare with zero", {at, at}, " ! 0", Safety::Safe);
      return d;
    }
    return expected("a comparison: `=`, `!`, `<` or `>`");
  }

  Diagnostic expected_parenthesis() const {
    if (!token().empty() && is_relation(token()[0]))
      return fault_.statement == spec::Statement::If
                 ? make(rules::ParenthesizedRelation, "a comparison cannot be in parentheses",
                        "remove the parentheses: `if A > 1 and B < 2 then`")
                 : make(rules::SyntaxError, "comparisons are only allowed in `if`");
    if (token() == ".")
      return unsupported_number();
    return expected("`)`");
  }

  Diagnostic expected_comma() const {
    const auto& row = spec::info(fault_.statement);
    if (row.form == spec::Form::Arguments && (token().empty() || token() == "else"))
      return make(rules::SyntaxError, fmt::format("{}, found {}", takes(), fault_.found), form());
    if (token() == ".")
      return unsupported_number();
    return expected("`,`");
  }

  Diagnostic expected_equals() const {
    if (token().size() > 1 && token()[0] == '=')
      return bad_operator(fault_.span);
    return expected("`=`");
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
                   fmt::format("`{}` is not a decimal integer", program_.text_of(span)),
                   "orbBasic has only integers; count in tenths or hundredths");
  }

  Diagnostic trailing() const {
    const auto here = token();
    const char last = before(fault_.span.begin);
    if (here.empty())
      return expected("the end of the line");
    if (here == "." ||
        ((here[0] == 'x' || here[0] == 'X') && last == '0' && text_[fault_.span.begin - 1] == '0'))
      return unsupported_number();
    if (!here.empty() && is_relation(here[0])) {
      if (here.size() > 1)
        return bad_operator(fault_.span);
      return make(rules::SyntaxError, "comparisons are only allowed in `if`");
    }
    const bool branches = spec::info(fault_.statement).form == spec::Form::Branch ||
                          fault_.statement == spec::Statement::On;
    if (branches && spec::find_operator(here[0]))
      return non_literal();
    if (fault_.statement == spec::Statement::Print && is_letter(here[0]) &&
        find_word(here).kind == WordKind::Unknown)
      return unknown_name();
    const auto what = fault_.statement == spec::Statement::Let
                          ? std::string("assignment")
                          : fmt::format("`{}` statement", word());
    return make(rules::SyntaxError, fmt::format("unexpected {} after the {}", found(), what));
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
