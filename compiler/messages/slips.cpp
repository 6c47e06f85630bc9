#include "compiler/messages/slips.h"

#include "base/text.h"
#include "compiler/messages/fault_text.h"
#include "compiler/messages/foreign.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <array>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Statement;

constexpr std::int32_t second_ms = 1000; // `delay` counts in milliseconds

class Slip : public FaultText {
public:
  using FaultText::FaultText;

  std::optional<Diagnostic> explain() const {
    using Guess = std::optional<Diagnostic> (Slip::*)() const;
    constexpr std::array guesses{
        &Slip::curly_quotes,
        &Slip::foreign_sign,
        &Slip::foreign_statement,
        &Slip::label,
        &Slip::named_line,
        &Slip::long_name,
        &Slip::foreign_value,
        &Slip::fraction_random,
        &Slip::colour_name,
        &Slip::unquoted_text,
        &Slip::compound,
        &Slip::list_element,
        &Slip::string_variable,
        &Slip::parenthesised,
        &Slip::missing_comma,
        &Slip::other_number,
        &Slip::time_unit,
        &Slip::next_alone,
        &Slip::missing_then,
        &Slip::empty_branch,
        &Slip::short_sleep,
        &Slip::colon,
        &Slip::joined_strings,
        &Slip::useless_semicolon,
        &Slip::quoted_target,
        &Slip::roll,
        &Slip::unended_string,
        &Slip::nested_if,
        &Slip::relation_in_parentheses,
    };
    static_assert(std::is_same_v<decltype(guesses)::value_type, Guess>);
    for (const auto guess : guesses)
      if (auto diagnostic = (this->*guess)())
        return diagnostic;
    return std::nullopt;
  }

private:
  bool is(Reason reason) const { return fault_.reason == reason; }
  bool in(Statement statement) const { return fault_.statement == statement; }
  std::uint32_t begin() const { return fault_.span.begin; }
  std::uint32_t end() const { return fault_.span.end; }
  bool wordy() const { return !token().empty() && is_letter(token()[0]); }

  // ---- words and signs

  std::optional<Diagnostic> foreign_statement() const {
    const bool first = is(Reason::UnknownWord) || is(Reason::MissingNumber);
    const bool chosen = is(Reason::ExpectedGotoOrGosub); // `on A call 100`
    const auto* row = first || chosen ? find_foreign(token(), Foreign::Place::Statement) : nullptr;
    if (row == nullptr || (chosen && row->instead != "gosub") || after(end()) == '=' ||
        after(end()) == ':')
      return std::nullopt;
    const bool remark = row->instead == "'";
    if (is(Reason::MissingNumber) && !remark)
      return std::nullopt; // the number comes first
    auto d = finding(remark ? rules::Rem : rules::UnknownStatement, fault_.span,
                     fmt::format("`{}` is not a statement", token()), std::string(row->help));
    if (remark && is(Reason::MissingNumber))
      d.help = "write `'`: comments need no number and are stripped before upload";
    if (row->instead == "delay" && short_time(d))
      return d;
    if (row->instead == "--")
      leave_out(d);
    else
      replace(d, *row, fault_.span);
    return d;
  }

  /// A wait for so few was meant in seconds, most likely.
  static constexpr std::int32_t most_seconds = 15;

  bool short_time(Diagnostic& d) const {
    const Span digits = digits_at(skip_blanks(end()));
    const auto value = number_in(digits);
    if (!value || *value > most_seconds || skip_blanks(digits.end) != code_end())
      return false;
    const auto line = fmt::format("delay {}", *value * second_ms);
    d.help = fmt::format("write `{}`; it takes milliseconds", line);
    d.fix = Fix{fmt::format("write `{}`", line), {{{begin(), digits.end}, line}}, Safety::Unsafe};
    return true;
  }

  /// Removes the line where it holds nothing else; what jumps to it goes to the next line.
  void leave_out(Diagnostic& d) const {
    const auto below = std::find_if(program_.lines.begin() + fault_.line + 1, program_.lines.end(),
                                    [](const Line& line) { return line.has_number(); });
    std::vector<Edit> edits;
    for (const auto& item : program_.items)
      if (item.kind == ItemKind::Target && item.value == line_.number && line_.has_number())
        edits.push_back(
            {item.span, below == program_.lines.end() ? "" : std::to_string(below->number)});
    if (line_.comment.size() > 0 || skip_blanks(end()) != code_end() ||
        (!edits.empty() && below == program_.lines.end()))
      return;
    auto next = std::min<std::size_t>(line_.span.end, text_.size());
    if (next < text_.size()) // CR, LF or both
      next += text_.substr(next).starts_with("\r\n") ? 2 : 1;
    edits.push_back({{line_.span.begin, static_cast<std::uint32_t>(next)}, ""});
    std::sort(edits.begin(), edits.end(),
              [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
    d.fix = Fix{"remove the line", std::move(edits), Safety::Safe};
  }

  std::optional<Diagnostic> foreign_value() const {
    const bool inside = is(Reason::ExpectedExpression) || is(Reason::Trailing) ||
                        is(Reason::ExpectedThen) || is(Reason::ExpectedRelation) ||
                        is(Reason::ExpectedComma) || is(Reason::ExpectedParenthesis) ||
                        is(Reason::ExpectedTo);
    const auto* row = inside && wordy() ? find_foreign(token(), Foreign::Place::Value) : nullptr;
    if (row == nullptr || spec::find_variable(token()) || spec::find_function(token()))
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span,
                     fmt::format("`{}` is neither a variable nor a function", token()),
                     std::string(row->help));
    replace(d, *row, fault_.span);
    return d;
  }

  std::optional<Diagnostic> foreign_sign() const {
    if (token().empty() || wordy() || token()[0] == '"')
      return std::nullopt;
    const auto at = begin();
    for (const Span span : {Span{at, at + 2}, Span{at - 1, at + 1}, Span{at, at + 1}}) {
      if (span.begin < line_.span.begin || span.end > line_.span.end || span.begin > at)
        continue;
      const auto* row = find_foreign(program_.text_of(span), Foreign::Place::Value);
      if (row == nullptr)
        continue;
      auto d = finding(rules::SyntaxError, span,
                       fmt::format("`{}` means nothing in orbBasic", row->spelling),
                       std::string(row->help));
      if (row->instead != "'" || span.begin > line_.span.begin || !line_.has_number())
        replace(d, *row, span);
      return d;
    }
    return std::nullopt;
  }

  void replace(Diagnostic& d, const Foreign& row, Span span) const {
    if (row.instead == "-") {
      offer(d, fmt::format("remove `{}`", program_.text_of(span)),
            {{{span.begin, skip_blanks(span.end)}, ""}});
    } else if (!row.instead.empty()) {
      const bool letter = is_letter(row.instead[0]);
      const bool tight = letter && span.begin > 0 && !is_blank(text_[span.begin - 1]);
      const bool joins = letter && span.end < line_.span.end && !is_blank(text_[span.end]);
      offer(d, fmt::format("write `{}`", row.instead),
            {{span, fmt::format("{}{}{}", tight ? " " : "", row.instead, joins ? " " : "")}});
    }
  }

  // ---- names

  /// `start:`, a label.
  std::optional<Diagnostic> label() const {
    if (!is(Reason::UnknownWord) || after(end()) != ':')
      return std::nullopt;
    const auto colon = skip_blanks(end());
    auto d = finding(rules::UnknownStatement, {begin(), colon + 1},
                     fmt::format("`{}:` is a label; orbBasic has none", token()),
                     fmt::format("jump to the line by its number: `goto {}`", line_.number));
    if (edits_of_name({}).size() > 1)
      return d; // the jumps to it come first
    if (skip_blanks(colon + 1) == code_end())
      offer(d, "make it a comment", {{{begin(), begin()}, "' "}});
    else
      offer(d, "remove the label", {{{begin(), skip_blanks(colon + 1)}, ""}});
    return d;
  }

  /// `goto start`, where a line begins with that label or comment.
  std::optional<Diagnostic> named_line() const {
    if (!is(Reason::ExpectedTarget) || !wordy() || token().size() < 2)
      return std::nullopt;
    auto d = finding(rules::NonLiteralTarget, fault_.span,
                     fmt::format("`{}` takes a plain line number, found `{}`",
                                 spec::info(fault_.statement).word, token()),
                     "jump to a line by its number: `goto 100`");
    const auto name = program_.text_of(word_at(begin()));
    for (const auto& line : program_.lines) {
      if (!line.has_number() || line.number_span.size() == 0)
        continue;
      auto rest = program_.text.substr(line.number_span.end, line.span.end - line.number_span.end);
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t'"), rest.size()));
      if (rest.size() <= name.size() || rest.substr(0, name.size()) != name ||
          rest[name.size()] != ':')
        continue;
      d.help = fmt::format("write `goto {}`, the number of that line", line.number);
      offer(d, fmt::format("write `{}`", line.number),
            {{fault_.span, std::to_string(line.number)}});
      break;
    }
    return d;
  }

  /// A variable with a name of more than one letter: the first of a program gets a free letter.
  std::optional<Diagnostic> long_name() const {
    const bool set = is(Reason::UnknownWord) && after(end()) == '=';
    const bool counts = is(Reason::ExpectedUserVariable) && wordy();
    if ((!set && !counts) || find_word(token()).kind != WordKind::Unknown)
      return std::nullopt;
    for (const auto& row : spec::variables)
      if (row.access == spec::Access::ReadWrite && equal_words(row.word, token()))
        return std::nullopt;
    auto d = finding(set ? rules::UnknownStatement : rules::SyntaxError, fault_.span,
                     fmt::format("`{}` is not a variable", token()), "variables are named A to Z");
    const auto letter = free_letter();
    if (!letter)
      return d;
    d.help = fmt::format("variables are named A to Z: write `{}`", *letter);
    if (&fault_ == &first_name())
      d.fix = Fix{fmt::format("call it `{}` everywhere", *letter), edits_of_name({&*letter, 1}),
                  Safety::Safe};
    return d;
  }

  /// The first letter of the name where nobody has it, else another free one; never Y and Z.
  std::optional<char> free_letter() const {
    std::uint32_t used = 0;
    for (std::uint32_t i = 0; i < text_.size(); ++i)
      if (is_letter(text_[i]) && (i == 0 || !is_letter(text_[i - 1])) &&
          (i + 1 == text_.size() || !is_letter(text_[i + 1])))
        used |= std::uint32_t{1} << (to_lower(text_[i]) - 'a');
    const auto is_free = [&](char c) { return (used >> (c - 'A') & 1) == 0; };
    const char initial = to_upper(token()[0]);
    if (initial < 'Y' && is_free(initial))
      return initial;
    for (char c = 'A'; c < 'Y'; ++c)
      if (is_free(c))
        return c;
    return std::nullopt;
  }

  /// The first fault that is such a name: two fixes of one round would take the same letter.
  const Fault& first_name() const {
    for (const auto& fault : program_.faults)
      if (fault.reason == Reason::UnknownWord || fault.reason == Reason::ExpectedUserVariable)
        if (&fault == &fault_ || Slip(program_, fault).long_name_here())
          return fault;
    return fault_;
  }
  bool long_name_here() const {
    return (is(Reason::UnknownWord) && after(end()) == '=') ||
           (is(Reason::ExpectedUserVariable) && wordy());
  }

  /// Every occurrence of the token as a word outside of strings and comments.
  std::vector<Edit> edits_of_name(std::string_view letter) const {
    std::vector<Edit> edits;
    for (const auto& line : program_.lines) {
      const auto stop = line.comment.size() > 0 ? line.comment.begin : line.span.end;
      bool quoted = false;
      for (auto i = line.span.begin; i < stop; ++i) {
        quoted = quoted != (text_[i] == '"');
        if (quoted || !is_letter(text_[i]) || (i > 0 && is_letter(text_[i - 1])))
          continue;
        auto word_end = i;
        while (word_end < stop && is_letter(text_[word_end]))
          ++word_end;
        if (equal_words(text_.substr(i, word_end - i), token()))
          edits.push_back({{i, word_end}, std::string(letter)});
      }
    }
    return edits;
  }

  // ---- values

  std::optional<Diagnostic> colour_name() const {
    if (!is(Reason::ExpectedExpression) || !wordy() ||
        (!in(Statement::Rgb) && !in(Statement::Ledc)))
      return std::nullopt;
    for (const auto& row : spec::led_colours) {
      if (!equal_words(row.name, token()))
        continue;
      const auto values = in(Statement::Ledc)
                              ? std::to_string(row.code)
                              : fmt::format("{},{},{}", row.red, row.green, row.blue);
      const auto line = fmt::format("{} {}", spec::info(fault_.statement).word, values);
      auto d = finding(rules::SyntaxError, fault_.span, "colours are numbers",
                       fmt::format("write `{}`", line));
      offer(d, d.help, {{fault_.span, values}});
      return d;
    }
    return std::nullopt;
  }

  /// `print Hello`.
  std::optional<Diagnostic> unquoted_text() const {
    const bool expected = is(Reason::ExpectedExpression) || is(Reason::Trailing);
    if (!expected || !in(Statement::Print) || !wordy() ||
        find_word(token()).kind != WordKind::Unknown)
      return std::nullopt;
    for (const auto& row : spec::variables)
      if (equal_words(row.word, token()))
        return std::nullopt;
    for (const auto& row : spec::functions)
      if (equal_words(row.word, token()))
        return std::nullopt;
    auto stop = end();
    while (stop < code_end() &&
           (is_letter(text_[stop]) || is_digit(text_[stop]) ||
            std::string_view(" .!?-").find(text_[stop]) != std::string_view::npos))
      ++stop;
    stop = skip_back(stop);
    const auto text = text_.substr(begin(), stop - begin());
    auto d = finding(rules::SyntaxError, fault_.span,
                     fmt::format("`{}` is neither a variable nor a function", token()),
                     fmt::format("text needs quotes: `print \"{}\"`", text));
    offer(d, "put it in quotes", {{{begin(), stop}, fmt::format("\"{}\"", text)}});
    return d;
  }

  /// `A += 1`, `A++`.
  std::optional<Diagnostic> compound() const {
    if (!is(Reason::ExpectedEquals) || token().size() != 1 || !spec::find_operator(token()[0]))
      return std::nullopt;
    const auto at = begin();
    const char sign = token()[0];
    const char next = at + 1 < line_.span.end ? text_[at + 1] : '\0';
    if (next != '=' && next != sign)
      return std::nullopt;
    const auto name_end = skip_back(at);
    auto name_begin = name_end;
    while (name_begin > 0 && is_letter(text_[name_begin - 1]))
      --name_begin;
    const auto name = text_.substr(name_begin, name_end - name_begin);
    const auto value_begin = skip_blanks(at + 2);
    const auto rest = next == '=' ? text_.substr(value_begin, code_end() - value_begin) : "1";
    const bool simple =
        std::all_of(rest.begin(), rest.end(), [](char c) { return is_letter(c) || is_digit(c); });
    const auto value = fmt::format("{}= {} {} {}{}{}", name_end == at ? " " : "", name, sign,
                                   simple ? "" : "(", rest, simple ? "" : ")");
    auto d = finding(rules::SyntaxError, {at, at + 2},
                     fmt::format("`{}` is not an operator", text_.substr(at, 2)),
                     fmt::format("write `{}{}{}`", name, name_end == at ? "" : " ", value));
    offer(d, d.help, {{{at, next == '=' ? code_end() : at + 2}, value}});
    return d;
  }

  /// `A(1) = 3`.
  std::optional<Diagnostic> list_element() const {
    if (!is(Reason::ExpectedEquals) || (token() != "(" && token() != "["))
      return std::nullopt;
    return finding(rules::SyntaxError, fault_.span, "variables take no index",
                   "the only list is `Z`, and `Y` chooses the element: `Y = 1`, then `Z = 3`");
  }

  /// `A$`.
  std::optional<Diagnostic> string_variable() const {
    const bool place = is(Reason::ExpectedEquals) || is(Reason::ExpectedUserVariable) ||
                       is(Reason::ExpectedComma) || is(Reason::Trailing);
    if (!place || token() != "$")
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span, "there are no string variables",
                     in(Statement::Input) ? "`input` takes a number: write `input A`"
                                          : "text can only be printed: `print \"hello\"`");
    if (in(Statement::Input))
      offer(d, "remove `$`", {{fault_.span, ""}});
    return d;
  }

  /// `RGB(0,255,0)`.
  std::optional<Diagnostic> parenthesised() const {
    const auto& row = spec::info(fault_.statement);
    if (!is(Reason::ExpectedParenthesis) || token() != "," || row.form != spec::Form::Arguments)
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span,
                     fmt::format("`{}` takes its values without parentheses", row.word), form());
    const auto word = text_.rfind(row.word, begin());
    const auto open = skip_blanks(static_cast<std::uint32_t>(word + row.word.size()));
    const auto close = closing_from(begin());
    if (word != std::string_view::npos && text_[open] == '(' && close < line_.span.end)
      offer(d, "remove the parentheses",
            {{{open, open + 1}, is_blank(text_[open - 1]) ? "" : " "}, {{close, close + 1}, ""}});
    return d;
  }

  /// Where the parenthesis that is open at `offset` is closed; the end of the line where it is not.
  std::uint32_t closing_from(std::uint32_t offset) const {
    for (int depth = 1; offset < line_.span.end; ++offset) {
      depth += text_[offset] == '(' ? 1 : text_[offset] == ')' ? -1 : 0;
      if (depth == 0)
        break;
    }
    return offset;
  }

  /// `RGB 255 0 0`.
  std::optional<Diagnostic> missing_comma() const {
    const auto& row = spec::info(fault_.statement);
    if (!is(Reason::ExpectedComma) || row.form != spec::Form::Arguments || token().empty() ||
        (!is_digit(token()[0]) && find_word(token()).kind == WordKind::Unknown && token() != "("))
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span,
                     fmt::format("a comma is missing before `{}`", token()), form());
    offer(d, "insert a comma", {{{skip_back(begin()), begin()}, ","}});
    return d;
  }

  /// `RND(1)*6`, a fraction times a number.
  std::optional<Diagnostic> fraction_random() const {
    const auto open = end();
    if (!is(Reason::ExpectedExpression) || !equal_words(token(), "rnd") || after(open) != '(')
      return std::nullopt;
    const auto digit = digits_at(skip_blanks(open) + 1);
    const auto close = skip_blanks(digit.end);
    const auto most = digits_at(skip_blanks(skip_blanks(close + 1) + 1));
    if (after(close) != ')' || after(close + 1) != '*' || number_in(digit).value_or(2) > 1 ||
        most.size() == 0)
      return std::nullopt;
    const auto call = fmt::format("rnd {}", program_.text_of(most));
    auto d =
        finding(rules::SyntaxError, fault_.span, fmt::format("`{}` is not a function", token()),
                fmt::format("write `{}`: a number from 1 to {}", call, program_.text_of(most)));
    offer(d, fmt::format("write `{}`", call), {{{begin(), most.end}, call}});
    return d;
  }

  // ---- numbers

  Span digits_at(std::uint32_t offset) const {
    auto stop = offset;
    while (stop < line_.span.end && is_digit(text_[stop]))
      ++stop;
    return {offset, stop};
  }
  std::optional<std::int32_t> number_in(Span span) const {
    return parse_number<std::int32_t>(text_.substr(span.begin, span.size()));
  }

  /// `0xff` and `1.5`.
  std::optional<Diagnostic> other_number() const {
    auto from = begin();
    while (from > line_.span.begin && is_digit(text_[from - 1]))
      --from;
    auto to = end();
    while (to < line_.span.end && (is_digit(text_[to]) || is_letter(text_[to])))
      ++to;
    const auto text = text_.substr(from, to - from);
    if (text.starts_with("0x") || text.starts_with("0X")) {
      const auto value = parse_number<std::int32_t>(text.substr(2), 16);
      if (!value)
        return std::nullopt;
      auto d = finding(rules::UnsupportedNumber, {from, to},
                       fmt::format("`{}` is not a whole decimal number", text),
                       fmt::format("write `{}`", *value));
      offer(d, d.help, {{{from, to}, std::to_string(*value)}});
      return d;
    }
    if (token() != "." || !in(Statement::Delay))
      return std::nullopt;
    return seconds(from, begin(), to);
  }

  /// `delay 1.5`: seconds, most likely.
  std::optional<Diagnostic> seconds(std::uint32_t from, std::uint32_t point,
                                    std::uint32_t to) const {
    auto fraction = std::string(text_.substr(point + 1, to - point - 1));
    const bool whole = std::all_of(fraction.begin(), fraction.end(), is_digit);
    const auto before_point = point > from ? number_in({from, point}) : std::optional(0);
    constexpr std::int32_t most = 65;
    if (!whole || !before_point || *before_point > most || fraction.empty())
      return std::nullopt;
    fraction.resize(3, '0');
    const auto line = fmt::format("delay {}", *before_point * second_ms + std::stoi(fraction));
    auto d =
        finding(rules::UnsupportedNumber, {from, to},
                fmt::format("`{}` is not a whole decimal number", text_.substr(from, to - from)),
                fmt::format("`delay` takes milliseconds: write `{}`", line));
    offer(d, fmt::format("write `{}`", line), {{{from, to}, line.substr(line.find(' ') + 1)}});
    return d;
  }

  /// `delay 500ms`, `delay 2s`.
  std::optional<Diagnostic> time_unit() const {
    if (!is(Reason::Trailing) || !in(Statement::Delay) || !wordy())
      return std::nullopt;
    const bool milliseconds = token() == "ms" || token() == "msec";
    const bool whole_seconds = token() == "s" || token() == "sec" || token() == "seconds";
    if (!milliseconds && !whole_seconds)
      return std::nullopt;
    auto from = skip_back(begin());
    const auto stop = from;
    while (from > line_.span.begin && is_digit(text_[from - 1]))
      --from;
    const auto value = number_in({from, stop});
    if (!value)
      return std::nullopt;
    const auto time = std::int64_t{*value} * (milliseconds ? 1 : second_ms);
    auto d = finding(rules::SyntaxError, fault_.span, "numbers have no units",
                     fmt::format("`delay` takes milliseconds: write `delay {}`", time));
    offer(d, fmt::format("write `delay {}`", time), {{{from, end()}, std::to_string(time)}});
    return d;
  }

  // ---- statements

  /// `next` without its letter: that of the innermost loop above.
  std::optional<Diagnostic> next_alone() const {
    if (!is(Reason::ExpectedUserVariable) || !in(Statement::Next) || !token().empty())
      return std::nullopt;
    std::vector<std::string_view> open;
    for (const auto& node : program_.statements) {
      if (node.span.begin >= begin())
        break;
      if (node.error)
        continue;
      if (node.kind == Statement::For)
        open.push_back(program_.text_of(program_.as<ForView>(node).variable.span));
      else if (node.kind == Statement::Next && !open.empty())
        open.pop_back();
    }
    for (const auto& fault : program_.faults) // a `next` above that has no letter either
      if (&fault < &fault_ && fault.reason == fault_.reason &&
          fault.statement == fault_.statement && !open.empty())
        open.pop_back();
    const auto letter = open.empty() ? std::string_view("I") : open.back();
    auto d = finding(rules::SyntaxError, fault_.span, "`next` names the variable of its loop",
                     fmt::format("write `next {}`", letter));
    if (!open.empty())
      offer(d, d.help, {{{begin(), begin()}, fmt::format(" {}", letter)}});
    return d;
  }

  /// `if A = 5 goto 10`.
  std::optional<Diagnostic> missing_then() const {
    if (!is(Reason::ExpectedThen) || token().empty() || token() == "and" || token() == "or")
      return std::nullopt;
    const auto kind = find_word(token()).kind;
    if (kind != WordKind::Statement && !is_digit(token()[0]))
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span,
                     fmt::format("expected `then`, found `{}`", token()),
                     is_digit(token()[0]) ? fmt::format("write `then goto {}`", token())
                                          : fmt::format("write `then {}`", token()));
    offer(d, "insert `then`",
          {{{begin(), begin()}, is_digit(token()[0]) ? "then goto " : "then "}});
    return d;
  }

  /// `if A = 5 then` with its statement on the next line, and the `end if` that closes it.
  std::optional<Diagnostic> empty_branch() const {
    if (is(Reason::Trailing) && in(Statement::End) && equal_words(token(), "if")) {
      auto d = finding(rules::SyntaxError, fault_.span, "an `if` ends at the end of its line",
                       "leave this line out");
      leave_out(d);
      return d;
    }
    if (!is(Reason::ExpectedStatement) || !in(Statement::If) || !token().empty())
      return std::nullopt;
    return finding(rules::SyntaxError, fault_.span, "the statement of the `if` is missing",
                   "an `if` holds its statement on the same line: `if A = 5 then LEDC 2`");
  }

  /// `sleep 5`.
  std::optional<Diagnostic> short_sleep() const {
    const bool one =
        (is(Reason::ExpectedComma) || is(Reason::ExpectedExpression)) && fault_.found == 1;
    if (!one || !in(Statement::Sleep) || !token().empty())
      return std::nullopt;
    auto stop = skip_back(begin());
    stop -= before(stop) == ')' ? 1 : 0;
    auto from = stop;
    while (from > line_.span.begin && (is_digit(text_[from - 1])))
      --from;
    const auto value = number_in({from, stop});
    const auto number = value.value_or(1);
    const auto line = fmt::format("delay {}", number > most_seconds ? number : number * second_ms);
    auto d = finding(rules::SyntaxError, fault_.span, "`sleep` takes 3 values, found 1",
                     fmt::format("`sleep` switches the ball off; to wait write `{}`", line));
    constexpr std::string_view word = "sleep";
    const auto before_value =
        text_.substr(0, skip_back(before(from) == '(' ? skip_back(from) - 1 : from));
    if (number > most_seconds && before_value.ends_with(word))
      offer(d, fmt::format("write `{}`", line),
            {{{static_cast<std::uint32_t>(before_value.size() - word.size()), skip_back(begin())},
              line}});
    return d;
  }

  /// `print "a" : end`: the rest gets a line of its own where a number is free.
  std::optional<Diagnostic> colon() const {
    if (token() != ":" || (!is(Reason::Trailing) && !is(Reason::ExpectedStatement)))
      return std::nullopt;
    auto d = finding(rules::Colon, fault_.span,
                     "a line takes one statement; `:` does not separate statements",
                     "put what follows on a line of its own");
    // After `then` the rest belongs to the branch, which holds one statement.
    const bool branch = program_.text_of(word_at(skip_blanks(line_.number_span.end))) == "if";
    if (!line_.has_number() || line_.number_span.size() == 0 || branch)
      return d;
    const auto number = free_number_below();
    const auto rest = skip_blanks(end());
    if (!number || rest == code_end())
      return d;
    d.help = fmt::format("put what follows on a line of its own: `{} {}`", *number,
                         text_.substr(rest, code_end() - rest));
    offer(d, fmt::format("make it line {}", *number),
          {{{skip_back(begin()), rest}, fmt::format("\n{} ", *number)}});
    return d;
  }

  /// A number between this line's and the next one's.
  std::optional<std::uint32_t> free_number_below() const {
    auto above = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)) + 1;
    for (auto i = fault_.line + 1; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number()) {
        above = program_.lines[i].number;
        break;
      }
    const auto number = above > line_.number + 10 ? line_.number + 5 : line_.number + 1;
    const bool named =
        std::any_of(program_.items.begin(), program_.items.end(), [&](const Item& item) {
          return item.kind == ItemKind::Target && item.value == number;
        });
    return number < above && !named ? std::optional(number) : std::nullopt;
  }

  /// `print "a" + "b"`.
  std::optional<Diagnostic> joined_strings() const {
    const bool beside = before(begin()) == '"' || after(end()) == '"';
    if (!is(Reason::Trailing) || !in(Statement::Print) || token() != "+" || !beside)
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span, "text is not joined with `+`",
                     "write them side by side: `print \"a\" \"b\"`");
    offer(d, "write a space", {{{skip_back(begin()), skip_blanks(end())}, " "}});
    return d;
  }

  std::optional<Diagnostic> useless_semicolon() const {
    if (!is(Reason::Trailing) || token() != ";" || skip_blanks(end()) != code_end())
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span,
                     "a statement ends at the end of its line, not with `;`", "leave it out");
    offer(d, "remove `;`", {{fault_.span, ""}});
    return d;
  }

  /// `goto "10"`.
  std::optional<Diagnostic> quoted_target() const {
    const auto number = digits_at(begin() + 1);
    if (!is(Reason::ExpectedTarget) || token().empty() || token()[0] != '"' || number.size() == 0 ||
        !text_.substr(number.end).starts_with('"'))
      return std::nullopt;
    auto d = finding(rules::NonLiteralTarget, fault_.span, "a line number takes no quotes",
                     fmt::format("write `goto {}`", program_.text_of(number)));
    offer(d, "remove the quotes",
          {{{begin(), number.end + 1}, std::string(program_.text_of(number))}});
    return d;
  }

  /// `roll 90,100`: the sensor's name for the statement.
  std::optional<Diagnostic> roll() const {
    if (!is(Reason::ReadOnly) || spec::find_variable(token()) != spec::Variable::Roll ||
        after(end()) == '=')
      return std::nullopt;
    auto d = finding(rules::AssignToSensor, fault_.span, "`roll` can only be read",
                     "drive with `goroll 90,100,1`: heading, speed, 1 to drive");
    offer(d, "write `goroll`", {{fault_.span, "goroll"}});
    return d;
  }

  std::optional<Diagnostic> unended_string() const {
    if (!is(Reason::ExpectedQuote))
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span, "the string has no closing `\"`",
                     "add `\"` at its end");
    const auto stop = skip_back(line_.span.end);
    offer(d, d.help, {{{stop, stop}, "\""}});
    return d;
  }

  /// `if A > 1 then if B > 2 then …`.
  std::optional<Diagnostic> nested_if() const {
    if (!is(Reason::NestedIf))
      return std::nullopt;
    const auto stop = skip_back(begin());
    constexpr std::string_view then = "then";
    auto d = finding(rules::NestedIf, fault_.span, "an `if` cannot stand inside another `if`",
                     "join two comparisons with `and`, or jump over lines with `goto`");
    if (!text_.substr(0, stop).ends_with(then))
      d.help = "write the second `if` on a line of its own";
    else
      offer(d, "join the comparisons with `and`",
            {{{stop - static_cast<std::uint32_t>(then.size()), end()}, "and"}});
    return d;
  }

  /// `if (A > 5) then`: every parenthesis that holds a comparison goes.
  std::optional<Diagnostic> relation_in_parentheses() const {
    const bool relation = !token().empty() && spec::find_relation(token()[0]);
    if (!is(Reason::ExpectedParenthesis) || !in(Statement::If) || !relation)
      return std::nullopt;
    auto d = finding(rules::ParenthesizedRelation, fault_.span,
                     "a comparison cannot stand in parentheses",
                     "leave the parentheses out: `if A > 1 and B < 2 then`");
    auto open = begin();
    for (int depth = 1; depth > 0 && open > line_.span.begin;) {
      --open;
      depth += text_[open] == ')' ? 1 : text_[open] == '(' ? -1 : 0;
    }
    const auto close = closing_from(end());
    if (text_[open] == '(' && close < line_.span.end) {
      const auto side = [&](char c) { return is_letter(c) ? " " : ""; };
      offer(d, "remove the parentheses",
            {{{open, open + 1}, side(text_[open - 1])},
             {{close, close + 1}, close + 1 < line_.span.end ? side(text_[close + 1]) : ""}});
    }
    return d;
  }

  // ---- quotes

  /// Quotes as a text editor draws them.
  std::optional<Diagnostic> curly_quotes() const {
    constexpr std::array<std::string_view, 4> curly{"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E",
                                                    "\xE2\x80\x9F"};
    if (std::find(curly.begin(), curly.end(), token()) == curly.end())
      return std::nullopt;
    auto d = finding(rules::SyntaxError, fault_.span, "the quotes are curly",
                     "write straight ones: `\"hello\"`");
    std::vector<Edit> edits;
    for (auto i = line_.span.begin; i + 3 <= line_.span.end; ++i)
      if (std::find(curly.begin(), curly.end(), text_.substr(i, 3)) != curly.end())
        edits.push_back({{i, i + 3}, "\""});
    offer(d, "write straight quotes", std::move(edits));
    return d;
  }
};

} // namespace

std::optional<Diagnostic> explain_slip(const Program& program, const Fault& fault) {
  return Slip(program, fault).explain();
}

} // namespace orb::compiler
