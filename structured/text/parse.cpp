#include "structured/text/parse.h"

#include "base/utf8.h"
#include "structured/text/blocks.h"
#include "structured/text/builder.h"
#include "structured/text/grammar.h"
#include "structured/text/messages.h"
#include "structured/text/numeral.h"
#include "structured/text/rules.h"
#include "structured/text/words.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <utility>

namespace orb::structured {
namespace {

const char* find_line_end(const char* p, const char* end) {
  return std::find_if(p, end, is_line_end);
}

template <typename Input>
std::string_view peek_name(const Input& in) {
  if (in.empty() || !begins_name(*in.current()))
    return {};
  const char* const end = end_of_name(in.current(), in.end());
  return {in.current(), static_cast<std::size_t>(end - in.current())};
}

template <typename Input>
void skip_blanks(Input& in) {
  while (!in.empty() && is_blank(*in.current()))
    in.bump(1);
}

/// Blanks, and what lies between a line and the one that it goes on in.
template <typename Input>
void skip_lines(Input& in) {
  for (;;) {
    skip_blanks(in);
    if (!in.empty() && *in.current() == '\'')
      in.bump(static_cast<std::size_t>(find_line_end(in.current(), in.end()) - in.current()));
    if (in.empty() || !is_line_end(*in.current()))
      return;
    in.bump(1);
  }
}

void add_numeral(Builder& builder, const char* begin, const char* end) {
  const auto numeral = read_numeral({begin, static_cast<std::size_t>(end - begin)});
  if (numeral.state == Numeral::State::Bad)
    throw Stop{Reason::BadNumber, begin, end};
  if (numeral.state == Numeral::State::Fraction)
    throw Stop{Reason::FractionOfMillisecond, begin, end};
  builder.leaf(numeral.duration ? NodeKind::Duration : NodeKind::Number, 0, numeral.value,
               builder.span(begin, end));
}

} // namespace

namespace grammar {

template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool gap::match(Input& in, Builder& builder) {
  if (builder.in_brackets())
    skip_lines(in);
  else
    skip_blanks(in);
  return true;
}

template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool join::match(Input& in, Builder& /*builder*/) {
  skip_lines(in);
  return true;
}

template <typename Rule, apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool match_one(Input& in, Builder& builder) {
  return Control<Rule>::template match<A, M, Action, Control>(in, builder);
}

template <typename Rule, apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
void must_match(Input& in, Builder& builder, Reason reason) {
  if (!match_one<Rule, A, M, Action, Control>(in, builder))
    throw Stop{reason, in.current()};
}

/// The index of an element, from its `[` to its `]`.
template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
void match_index(Input& in, Builder& builder, Span name, std::uint32_t id) {
  builder.open(in.current());
  in.bump(1);
  match_one<gap, A, M, Action, Control>(in, builder);
  must_match<condition, A, M, Action, Control>(in, builder, Reason::ExpectedExpression);
  must_match<element_end, A, M, Action, Control>(in, builder, Reason::ExpectedBracket);
  builder.close();
  const auto end = builder.span(in.current(), in.current()).begin;
  builder.unary(NodeKind::Element, 0, {name.begin, end});
  builder.last().value = static_cast<std::int32_t>(id);
}

/// The operands of a call, from its `(` to its `)`; returns how many there are.
template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
std::uint16_t match_operands(Input& in, Builder& builder) {
  builder.open(in.current());
  in.bump(1);
  match_one<gap, A, M, Action, Control>(in, builder);
  std::uint16_t count = 0;
  if (in.empty() || *in.current() != ')')
    do {
      must_match<condition, A, M, Action, Control>(in, builder, Reason::ExpectedExpression);
      ++count;
    } while (match_one<comma, A, M, Action, Control>(in, builder));
  must_match<group_end, A, M, Action, Control>(in, builder, Reason::ExpectedParenthesis);
  builder.close();
  return count;
}

/// A name that the program has made: a variable, an element or a call.
template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
void match_name(Input& in, Builder& builder, std::string_view name) {
  const auto where = builder.span(name.data(), name.data() + name.size());
  if (name.size() > longest_name)
    throw Stop{Reason::NameTooLong, name.data(), name.data() + name.size()};
  const auto id = builder.intern(where);
  const auto first = builder.nodes();
  in.bump(name.size());
  auto ahead = in.current();
  while (ahead != in.end() && is_blank(*ahead))
    ++ahead;
  const char next = ahead == in.end() ? '\0' : *ahead;
  if (next == '(') {
    in.bump(static_cast<std::size_t>(ahead - in.current()));
    const auto count = match_operands<A, M, Action, Control>(in, builder);
    const auto end = builder.span(in.current(), in.current()).begin;
    builder.over(NodeKind::Call, 0, first, {where.begin, end});
    builder.last().count = count;
    builder.last().value = static_cast<std::int32_t>(id);
  } else if (next == '[') {
    in.bump(static_cast<std::size_t>(ahead - in.current()));
    match_index<A, M, Action, Control>(in, builder, where, id);
  } else {
    builder.leaf(NodeKind::Name, 0, static_cast<std::int32_t>(id), where);
  }
}

template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool named_factor::match(Input& in, Builder& builder) {
  const auto name = peek_name(in);
  if (name.empty())
    return false;
  const auto where = builder.span(name.data(), name.data() + name.size());
  const auto word = find_word(name);
  if (word.kind == WordKind::Name) {
    match_name<A, M, Action, Control>(in, builder, name);
    return true;
  }
  if (word.kind == WordKind::Variable) {
    builder.leaf(NodeKind::System, word.index, 0, where);
    in.bump(name.size());
    return true;
  }
  if (!is_function(word))
    return false;
  const bool pair = word.kind == WordKind::Keyword;
  const auto first = builder.nodes();
  in.bump(name.size());
  skip_blanks(in);
  if (in.empty() || *in.current() != '(')
    throw Stop{Reason::ExpectedOperand, in.current()};
  const auto count = match_operands<A, M, Action, Control>(in, builder);
  if (count != (pair ? 2 : 1))
    throw Stop{pair ? Reason::ExpectedTwo : Reason::ExpectedOne, name.data(),
               name.data() + name.size()};
  const Span whole{where.begin, builder.span(in.current(), in.current()).begin};
  builder.over(!pair                   ? NodeKind::Builtin
               : word.is(Keyword::Min) ? NodeKind::Least
                                       : NodeKind::Greatest,
               word.index, first, whole);
  return true;
}

template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool place::match(Input& in, Builder& builder) {
  const auto name = peek_name(in);
  if (name.empty())
    return false;
  const auto word = find_word(name);
  const char* const end = name.data() + name.size();
  if (word.kind == WordKind::Variable) {
    if (spec::variables[word.index].access != spec::Access::ReadWrite)
      throw Stop{Reason::ReadOnly, name.data(), end};
    builder.leaf(NodeKind::System, word.index, 0, builder.span(name.data(), end));
    in.bump(name.size());
  } else if (word.kind != WordKind::Name) {
    throw Stop{Reason::Reserved, name.data(), end};
  } else {
    match_name<A, M, Action, Control>(in, builder, name);
    if (builder.last().kind == NodeKind::Call)
      throw Stop{Reason::ExpectedPlace, name.data(), in.current()};
  }
  builder.expression(ItemKind::Place);
  return match_one<gap, A, M, Action, Control>(in, builder);
}

template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool new_name::match(Input& in, Builder& builder) {
  const auto name = peek_name(in);
  if (name.empty())
    return false;
  const char* const end = name.data() + name.size();
  if (find_word(name).kind != WordKind::Name)
    throw Stop{Reason::Reserved, name.data(), end};
  if (name.size() > longest_name)
    throw Stop{Reason::NameTooLong, name.data(), end};
  const auto where = builder.span(name.data(), end);
  auto& statement = builder.statement();
  const auto id = builder.intern(where);
  if (statement.name == none && statement.kind != Kind::Local) {
    statement.name = id;
    statement.name_span = where;
  } else {
    builder.item(ItemKind::Name, id, where);
  }
  in.bump(name.size());
  return true;
}

template <apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool arguments::match(Input& in, Builder& builder) {
  const auto robot = builder.statement().robot;
  const auto& row = spec::info(robot);
  const auto most = row.parameters().size();
  const bool sleeps = robot == spec::Statement::Sleep;
  // `RGB` takes one colour, `sleep` what it is for.
  const std::size_t least = sleeps || robot == spec::Statement::Rgb ? 1 : row.required;
  if (robot == spec::Statement::Rgb && !in.empty() && *in.current() == '#') {
    std::uint32_t colour = 0;
    const char* const begin = in.current();
    const char* const end = end_of_name(begin + 1, in.end());
    const auto read = std::from_chars(begin + 1, end, colour, 16);
    if (end - begin != 7 || read.ptr != end)
      throw Stop{Reason::BadNumber, begin, end};
    builder.item(ItemKind::Colour, colour, builder.span(begin, end));
    in.bump(7);
    skip_blanks(in);
    return true;
  }
  for (std::size_t n = 0; n < most; ++n) {
    if (n > 0 && !match_one<comma, A, M, Action, Control>(in, builder)) {
      if (n >= least)
        return true;
      throw Stop{Reason::ExpectedComma, in.current()};
    }
    const auto name = peek_name(in);
    if (sleeps && n == 2 && equal_words(name, "restart")) {
      builder.item(ItemKind::Restart, 0, builder.span(name.data(), name.data() + name.size()));
      in.bump(name.size());
      skip_blanks(in);
    } else {
      must_match<expression, A, M, Action, Control>(in, builder, Reason::ExpectedExpression);
    }
  }
  if (most > 0 && !in.empty() && *in.current() == ',')
    throw Stop{Reason::TooManyArguments, in.current()};
  return true;
}

} // namespace grammar

namespace {

namespace g = grammar;

/// What is reported where a rule that must match does not.
template <typename Rule>
constexpr Reason reason = Reason::ExpectedExpression;
template <>
constexpr Reason reason<g::group_end> = Reason::ExpectedParenthesis;
template <>
constexpr Reason reason<g::parameters_end> = Reason::ExpectedParenthesis;
template <>
constexpr Reason reason<g::element_end> = Reason::ExpectedBracket;
template <>
constexpr Reason reason<g::array_begin> = Reason::ExpectedBracket;
template <>
constexpr Reason reason<g::equals> = Reason::ExpectedEquals;
template <>
constexpr Reason reason<g::place> = Reason::ExpectedPlace;
template <>
constexpr Reason reason<g::new_name> = Reason::ExpectedName;
template <>
constexpr Reason reason<g::names> = Reason::ExpectedName;
template <>
constexpr Reason reason<tao::pegtl::seq<g::new_name, g::gap>> = Reason::ExpectedName;
template <>
constexpr Reason reason<g::word_to> = Reason::ExpectedTo;
template <>
constexpr Reason reason<tao::pegtl::one<'"'>> = Reason::ExpectedQuote;
template <>
constexpr Reason reason<g::file_name> = Reason::ExpectedFile;

template <typename Rule>
struct Control : tao::pegtl::normal<Rule> {
  template <typename Input>
  [[noreturn]] static void raise(const Input& in, Builder& /*builder*/) {
    throw Stop{reason<Rule>, in.current()};
  }
};

template <typename Rule>
struct Action : tao::pegtl::nothing<Rule> {};

#define ORB_ACTION(rule, body)                                                                     \
  template <>                                                                                      \
  struct Action<g::rule> {                                                                         \
    template <typename Input>                                                                      \
    static void apply([[maybe_unused]] const Input& in, Builder& builder) {                        \
      body;                                                                                        \
    }                                                                                              \
  };

ORB_ACTION(numeral, add_numeral(builder, in.begin(), in.end()))
ORB_ACTION(group_begin, builder.open(in.begin()))
ORB_ACTION(group, builder.close())
ORB_ACTION(negation, builder.unary(NodeKind::Negate, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(product_tail, builder.operation(*in.begin()))
ORB_ACTION(sum_tail, builder.operation(*in.begin()))
ORB_ACTION(relation_tail, builder.relation(in.begin()))
ORB_ACTION(not_word, builder.open_not(in.begin()))
ORB_ACTION(negated, builder.close_not();
           builder.unary(NodeKind::Not, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(and_signs, builder.signs(in.begin(), "and"))
ORB_ACTION(or_signs, builder.signs(in.begin(), "or"))
ORB_ACTION(and_tail, builder.binary(NodeKind::And, 0))
ORB_ACTION(or_tail, builder.binary(NodeKind::Or, 0))
ORB_ACTION(expression, builder.expression(ItemKind::Expression))
ORB_ACTION(to_word, builder.item(ItemKind::To, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(text, builder.item(ItemKind::String, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(print_comma, builder.item(ItemKind::Comma, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(semicolon, builder.item(ItemKind::Semicolon, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(character, builder.program().items.back().kind = ItemKind::Character;
           builder.widen_item(in.begin()))
#undef ORB_ACTION

using Input =
    tao::pegtl::memory_input<tao::pegtl::tracking_mode::lazy, tao::pegtl::eol::lf, const char*>;

enum class Position : std::uint8_t { Line, Branch };

/// Parses the statements of a file one after the other.
class Lines {
public:
  Lines(Program& program, const char* begin, const char* end)
      : program_(program), builder_(program), base_(program.text.data()), begin_(begin), end_(end) {
  }

  void parse() {
    for (const char* p = begin_; p != end_;)
      p = parse_line(p);
  }

private:
  Span span(std::string_view text) const {
    return builder_.span(text.data(), text.data() + text.size());
  }

  const char* parse_line(const char* p) {
    Input in(p, end_, "");
    skip_lines(in);
    p = in.current();
    if (p == end_)
      return p;
    if (skip_foreign_comment(in))
      return in.current();
    builder_.begin_line();
    const auto mark = builder_.mark();
    try {
      if (is_digit(*p))
        return numbered(p);
      statement(in, Position::Line);
      builder_.begin_line();
      skip_blanks(in);
      skip_foreign_end(in);
      if (!at_end(in) && !skip_foreign_comment(in))
        throw Stop{Reason::Trailing, in.current()};
    } catch (const Stop& stop) {
      builder_.fail(mark, stop, p, end_);
      return resume(p, stop.begin);
    }
    return in.current();
  }

  /// A line with a number, which is said of the first one: the others have it for the same reason.
  const char* numbered(const char* p) {
    if (!numbered_)
      builder_.report(explain(program_, Reason::LineNumber, builder_.token(p, end_)));
    numbered_ = true;
    builder_.begin(Kind::Broken, builder_.span(p, p));
    return find_line_end(p, end_);
  }

  /// Where parsing goes on after a line that does not parse: the end of the line on which it
  /// shows, unless that only goes on because a bracket was never closed.
  const char* resume(const char* begin, const char* at) const {
    const char* last = at;
    while (last > begin && (is_blank(last[-1]) || is_line_end(last[-1])))
      --last;
    const bool joined = last > begin && !is_name_char(last[-1]) && last[-1] != ')' &&
                        last[-1] != ']' && last[-1] != '"';
    return find_line_end(joined && !begins_statement(last, at) ? at : last, end_);
  }

  /// Whether what stands at `at` is on another line than what ends at `last`, and a word that can
  /// only begin a statement.
  bool begins_statement(const char* last, const char* at) const {
    if (std::none_of(last, at, is_line_end) || at == end_ || !begins_name(*at))
      return false;
    const char* const end = end_of_name(at, end_);
    const auto word = find_word({at, static_cast<std::size_t>(end - at)});
    return word.kind == WordKind::Statement ||
           (word.kind == WordKind::Keyword && !is_function(word) && !word.is(Keyword::Not));
  }

  static bool at_end(const Input& in) {
    return in.empty() || is_line_end(*in.current()) || *in.current() == '\'';
  }

  /// `;` and `:` at the end of a line, which other languages want there.
  bool skip_foreign_end(Input& in, std::string_view instead = " ") {
    if (in.empty() || (*in.current() != ';' && *in.current() != ':'))
      return false;
    Input ahead(in.current() + 1, end_, "");
    skip_blanks(ahead);
    if (!at_end(ahead))
      return false;
    builder_.report(habit(program_, builder_.span(in.current(), in.current() + 1), instead));
    in.bump(static_cast<std::size_t>(ahead.current() - in.current()));
    return true;
  }

  /// `//` and `#` as they begin comments elsewhere, and `rem`.
  bool skip_foreign_comment(Input& in) {
    if (in.empty())
      return false;
    const char* const p = in.current();
    const bool slashes = *p == '/' && p + 1 != end_ && p[1] == '/';
    const bool remark = equal_words(peek_name(in), "rem");
    if (!slashes && *p != '#' && !remark)
      return false;
    builder_.report(habit(program_, builder_.span(p, p + (slashes ? 2 : remark ? 3 : 1)), "'"));
    in.bump(static_cast<std::size_t>(find_line_end(p, end_) - p));
    return true;
  }

  template <typename Rule>
  void tail(Input& in) {
    if (!tao::pegtl::parse<Rule, Action, Control>(in, builder_))
      throw Stop{reason<Rule>, in.current()};
  }

  /// Begins a statement at its word, which has been looked at.
  Statement& begin(Input& in, Kind kind, std::string_view word) {
    in.bump(word.size());
    skip_blanks(in);
    return builder_.begin(kind, span(word));
  }
  template <typename Rule>
  void simple(Input& in, Kind kind, std::string_view word) {
    begin(in, kind, word);
    tail<Rule>(in);
    builder_.finish(in.current());
  }
  void bare(Input& in, Kind kind, std::string_view word) {
    begin(in, kind, word);
    builder_.finish(in.current());
  }

  void statement(Input& in, Position position) {
    const auto name = peek_name(in);
    if (name.empty()) {
      if (*in.current() != '?')
        throw Stop{at_end(in) ? Reason::ExpectedStatement : Reason::NotAStatement, in.current()};
      print_line(in, {in.current(), 1});
      return;
    }
    const auto word = find_word(name);
    switch (word.kind) {
    case WordKind::Name: named(in, name, position); return;
    case WordKind::Variable: assignment(in); return;
    case WordKind::Function: throw Stop{Reason::NotAStatement, name.data()};
    case WordKind::Keyword: keyword(in, static_cast<Keyword>(word.index), name, position); return;
    case WordKind::Statement:
      robot(in, static_cast<spec::Statement>(word.index), name, position);
      return;
    }
  }

  void only_on_line(Position position, std::string_view word) const {
    if (position == Position::Branch)
      throw Stop{Reason::BlockInOneLine, word.data()};
  }

  /// `exit` and `continue`, which may stand in a branch.
  void leave_line(Input& in, Kind kind, std::string_view word) {
    bare(in, kind, word);
    const auto loop = peek_name(in); // `exit for`, as elsewhere
    if (kind == Kind::Exit && leave_routine(in, word, loop))
      return;
    if (is_loop_word(loop) || equal_words(loop, "do")) {
      builder_.report(habit(program_, builder_.span(word.data(), loop.data() + loop.size()), word));
      in.bump(loop.size());
    }
  }

  /// `exit sub` and `exit function`.
  bool leave_routine(Input& in, std::string_view word, std::string_view routine) {
    const bool function = find_word(routine).is(Keyword::Function);
    if (!function && !find_word(routine).is(Keyword::Sub))
      return false;
    const auto both = builder_.span(word.data(), routine.data() + routine.size());
    builder_.report(habit(program_, both, function ? "return 0" : "return"));
    in.bump(routine.size());
    builder_.statement().kind = Kind::Return;
    if (function) {
      builder_.leaf(NodeKind::Number, 0, 0, both);
      builder_.expression(ItemKind::Expression);
    }
    builder_.finish(in.current());
    return true;
  }

  void repeat_line(Input& in, std::string_view word) {
    begin(in, Kind::Repeat, word);
    if (!at_end(in)) {
      builder_.statement().kind = Kind::RepeatTimes;
      tail<g::one_value>(in);
    }
    builder_.finish(in.current());
  }

  void select_line(Input& in, std::string_view word) {
    begin(in, Kind::Select, word);
    if (equal_words(peek_name(in), "case")) {
      builder_.report(habit(program_, span(peek_name(in)), " "));
      in.bump(4);
      skip_blanks(in);
    }
    tail<g::one_value>(in);
    builder_.finish(in.current());
  }

  void case_line(Input& in, std::string_view word) {
    begin(in, Kind::Case, word);
    if (equal_words(peek_name(in), "else")) {
      builder_.statement().kind = Kind::Else;
      in.bump(4);
    } else {
      tail<g::case_values>(in);
    }
    builder_.finish(in.current());
  }

  void keyword(Input& in, Keyword keyword, std::string_view word, Position position) {
    if (keyword != Keyword::Exit && keyword != Keyword::Continue)
      only_on_line(position, word);
    switch (keyword) {
    case Keyword::Exit: leave_line(in, Kind::Exit, word); return;
    case Keyword::Continue: leave_line(in, Kind::Continue, word); return;
    case Keyword::Const: simple<g::constant>(in, Kind::Const, word); return;
    case Keyword::Local: simple<g::locals>(in, Kind::Local, word); return;
    case Keyword::Array: simple<g::array>(in, Kind::Array, word); return;
    case Keyword::Use: simple<g::file>(in, Kind::Use, word); return;
    case Keyword::Include: simple<g::file>(in, Kind::Include, word); return;
    case Keyword::ElseIf: conditional(in, Kind::ElseIf, word); return;
    case Keyword::Else: else_line(in, word); return;
    case Keyword::While: simple<g::one_value>(in, Kind::While, word); return;
    case Keyword::Repeat: repeat_line(in, word); return;
    case Keyword::Until: simple<g::one_value>(in, Kind::Until, word); return;
    case Keyword::Loop: loop_line(in, word); return;
    case Keyword::Select: select_line(in, word); return;
    case Keyword::Case: case_line(in, word); return;
    case Keyword::Sub: simple<g::routine>(in, Kind::Sub, word); return;
    case Keyword::Function: simple<g::routine>(in, Kind::Function, word); return;
    case Keyword::Then:
    case Keyword::To:
    case Keyword::Step:
    case Keyword::And:
    case Keyword::Or:
    case Keyword::Not:
    case Keyword::Min:
    case Keyword::Max: throw Stop{Reason::NotAStatement, word.data()};
    }
  }

  /// `if` and `elseif`: a condition and `then`.
  void conditional(Input& in, Kind kind, std::string_view word) {
    begin(in, kind, word);
    tail<g::one_value>(in);
    if (!tao::pegtl::parse<g::word_then, Action, Control>(in, builder_) &&
        !skip_foreign_end(in, " then")) {
      if (!at_end(in) || kind == Kind::If)
        throw Stop{Reason::ExpectedThen, in.current()};
    }
    builder_.finish(in.current());
  }

  void else_line(Input& in, std::string_view word) {
    skip_blanks(in);
    const char* const begin_word = in.current();
    in.bump(word.size());
    skip_blanks(in);
    if (equal_words(peek_name(in), "if")) { // `else if c then` opens no block of its own here
      const char* const end = in.current() + 2;
      builder_.report(habit(program_, builder_.span(begin_word, end), "elseif"));
      const auto joined = std::string_view(begin_word, static_cast<std::size_t>(end - begin_word));
      in.bump(2);
      skip_blanks(in);
      builder_.begin(Kind::ElseIf, span(joined));
      tail<g::one_value>(in);
      if (!tao::pegtl::parse<g::word_then, Action, Control>(in, builder_))
        throw Stop{Reason::ExpectedThen, in.current()};
      builder_.finish(in.current());
      return;
    }
    builder_.begin(Kind::Else, span(word));
    builder_.finish(in.current());
  }

  /// `do`, `do while c` and `do until c`; their `loop` decides what they are.
  struct Do {
    std::uint32_t statement;
    std::size_t finding; ///< a Diagnostic
  };

  /// `loop` begins a block here and ends one elsewhere.
  void loop_line(Input& in, std::string_view word) {
    if (do_lines_.empty()) {
      bare(in, Kind::Loop, word);
      return;
    }
    const auto begun = do_lines_.back();
    do_lines_.pop_back();
    const auto role = program_.statements[begun.statement].role();
    bare(in, role == Kind::While ? Kind::EndWhile : Kind::EndLoop, word);
    const auto after = peek_name(in);
    const bool until = find_word(after).is(Keyword::Until);
    auto& opener = program_.statements[begun.statement];
    if (opener.kind == Kind::Loop && (until || find_word(after).is(Keyword::While))) {
      opener.kind = Kind::Repeat;
      program_.diagnostics[begun.finding] = habit(program_, opener.word, "repeat");
      last_test(in, word, after, until);
      return;
    }
    builder_.report(habit(program_, span(word), words_of_end(builder_.statement().kind)));
  }

  /// `loop until c` and `loop while c`.
  void last_test(Input& in, std::string_view word, std::string_view after, bool until) {
    in.bump(after.size());
    skip_blanks(in);
    builder_.statement().kind = Kind::Until;
    const auto both = builder_.span(word.data(), after.data() + after.size());
    condition(in, both, until, "until");
  }

  /// The condition after `words` of another language, which is written after `instead` here: as it
  /// is, or its opposite.
  void condition(Input& in, Span words, bool as_is, std::string_view instead) {
    const char* const begin = in.current();
    tail<g::one_value>(in);
    builder_.finish(in.current());
    if (as_is) {
      builder_.report(habit(program_, words, instead));
      return;
    }
    const auto text =
        program_.text_of({builder_.span(begin, begin).begin, builder_.statement().span.end});
    builder_.unary(NodeKind::Not, 0, builder_.last().span);
    program_.items.back().value = builder_.nodes() - 1;
    auto d = habit(program_, words, {}, fmt::format("write `{} not ({})`", instead, text));
    d.fix = Fix{d.help,
                {Edit{{words.begin, builder_.statement().span.end},
                      fmt::format("{} not ({})", instead, text)}},
                Safety::Safe};
    builder_.report(std::move(d));
  }

  void robot(Input& in, spec::Statement robot, std::string_view word, Position position) {
    switch (robot) {
    case spec::Statement::If: if_line(in, word, position); return;
    case spec::Statement::For:
      only_on_line(position, word);
      simple<g::counting>(in, Kind::For, word);
      return;
    case spec::Statement::Next:
      only_on_line(position, word);
      simple<g::counted>(in, Kind::Next, word);
      return;
    case spec::Statement::Goto: simple<g::jump>(in, Kind::Goto, word); return;
    case spec::Statement::Gosub: throw Stop{Reason::Gosub, word.data()};
    case spec::Statement::On: throw Stop{Reason::On, word.data()};
    case spec::Statement::Return:
      begin(in, Kind::Return, word);
      if (!at_end(in) && !find_word(peek_name(in)).is(Keyword::Else))
        tail<g::one_value>(in);
      builder_.finish(in.current());
      return;
    case spec::Statement::Print: print_line(in, word); return;
    case spec::Statement::End: end_line(in, word, position); return;
    case spec::Statement::Let:
    case spec::Statement::Input:
    case spec::Statement::Delay:
    case spec::Statement::Rgb:
    case spec::Statement::Ledc:
    case spec::Statement::BackLed:
    case spec::Statement::Random:
    case spec::Statement::Goroll:
    case spec::Statement::Heading:
    case spec::Statement::Raw:
    case spec::Statement::Locate:
    case spec::Statement::Basflg:
    case spec::Statement::Data:
    case spec::Statement::Rstr:
    case spec::Statement::Read:
    case spec::Statement::Tron:
    case spec::Statement::Troff:
    case spec::Statement::Reset:
    case spec::Statement::Sleep:
    case spec::Statement::Macrun:
    case spec::Statement::Mackill: break;
    }
    begin(in, Kind::Robot, word).robot = robot;
    refuse_parentheses(in);
    switch (spec::info(robot).form) {
    case spec::Form::Entry: tail<g::entry>(in); break;
    case spec::Form::Values: tail<g::values>(in); break;
    case spec::Form::Variables: tail<g::places>(in); break;
    case spec::Form::Arguments: tail<g::arguments>(in); break;
    case spec::Form::Assignment:
    case spec::Form::Conditional:
    case spec::Form::Loop:
    case spec::Form::LoopEnd:
    case spec::Form::Branch:
    case spec::Form::IndexedBranch:
    case spec::Form::Output: break;
    }
    builder_.finish(in.current());
  }

  void print_line(Input& in, std::string_view word) {
    simple<g::output>(in, Kind::Print, word);
    const auto& statement = builder_.statement();
    if (statement.items_begin != statement.items_end || in.empty() || *in.current() != '\'')
      return;
    const char* const line_end = find_line_end(in.current(), end_);
    const char* const quote = std::find(in.current() + 1, line_end, '\'');
    if (quote == line_end || quote == in.current() + 1)
      return;
    Input rest(quote + 1, end_, "");
    skip_blanks(rest);
    if (at_end(rest))
      builder_.report(single_quotes(program_, builder_.span(in.current(), quote + 1)));
  }

  /// `goroll(0, 80, 1)`: a parenthesis around several values and the whole rest of the line.
  void refuse_parentheses(const Input& in) const {
    const char* const begin = in.current();
    if (in.empty() || *begin != '(')
      return;
    int depth = 0;
    bool comma = false;
    for (const char* p = begin; p != end_ && !is_line_end(*p) && *p != '\''; ++p) {
      depth += *p == '(' ? 1 : *p == ')' ? -1 : 0;
      comma = comma || (*p == ',' && depth == 1);
      if (depth > 0)
        continue;
      Input rest(p + 1, end_, "");
      skip_blanks(rest);
      if (comma && at_end(rest))
        throw Stop{Reason::Parenthesised, begin, p + 1};
      return;
    }
  }

  void if_line(Input& in, std::string_view word, Position position) {
    if (position == Position::Branch)
      throw Stop{Reason::NestedIf, word.data()};
    conditional(in, Kind::If, word);
    if (at_end(in))
      return;
    builder_.statement().one_line = true;
    statement(in, Position::Branch);
    skip_blanks(in);
    const auto otherwise = peek_name(in);
    if (equal_words(otherwise, "else")) {
      bare(in, Kind::Else, otherwise);
      builder_.statement().one_line = true;
      statement(in, Position::Branch);
    }
    const auto end = builder_.span(in.current(), in.current());
    builder_.begin(Kind::EndIf, end).one_line = true;
  }

  /// `end`, or `end` and what it ends.
  void end_line(Input& in, std::string_view word, Position position) {
    in.bump(word.size());
    skip_blanks(in);
    const auto what = peek_name(in);
    auto kind = end_of_block(what);
    const auto routine = foreign_routine(what);
    if (equal_words(what, "for") || routine) {
      kind = !routine ? Kind::Next : *routine == Kind::Sub ? Kind::EndSub : Kind::EndFunction;
      builder_.report(habit(program_, builder_.span(word.data(), what.data() + what.size()),
                            words_of_end(*kind)));
    }
    if (!kind) {
      builder_.begin(Kind::Robot, span(word)).robot = spec::Statement::End;
      builder_.finish(in.current());
      return;
    }
    only_on_line(position, word);
    in.bump(what.size());
    builder_.begin(*kind, builder_.span(word.data(), what.data() + what.size()));
    builder_.finish(in.current());
  }

  // ---- names at the beginning of a line

  void named(Input& in, std::string_view name, Position position) {
    const char* ahead = name.data() + name.size();
    while (ahead != end_ && is_blank(*ahead))
      ++ahead;
    const char next = ahead == end_ ? '\n' : *ahead;
    const char after = ahead == end_ || ahead + 1 == end_ ? '\n' : ahead[1];
    const bool signs = std::string_view("+-*/%").find(next) != std::string_view::npos;
    if (next == '=' || next == '[' || ((signs || next == ':') && after == '=')) {
      assignment(in);
      return;
    }
    if ((next == '+' || next == '-') && after == next) {
      step(in, name, {ahead, 2});
      return;
    }
    if (next == ':' && position == Position::Line) {
      begin(in, Kind::Label, name);
      builder_.statement().word = {};
      set_name(name);
      in.bump(1);
      builder_.finish(in.current());
      return;
    }
    if (next != '(' && foreign(in, name, position))
      return;
    call(in, name, next);
  }

  void set_name(std::string_view name) {
    if (name.size() > longest_name)
      throw Stop{Reason::NameTooLong, name.data()};
    builder_.statement().name = builder_.intern(span(name));
    builder_.statement().name_span = span(name);
  }

  void assignment(Input& in) {
    builder_.begin(Kind::Assign, builder_.span(in.current(), in.current()));
    tail<g::place>(in);
    const char* const sign = in.current();
    if (!in.empty() && *sign == ':' && sign + 1 != end_ && sign[1] == '=') {
      builder_.report(habit(program_, builder_.span(sign, sign + 2), "="));
      in.bump(1);
    } else if (!in.empty() && *sign != '=') {
      const auto operation = spec::find_operator(*sign);
      if (!operation || sign + 1 == end_ || sign[1] != '=' || *sign == '{' || *sign == '}' ||
          *sign == '&' || *sign == '|')
        throw Stop{Reason::ExpectedEquals, sign};
      builder_.statement().operation = static_cast<std::uint8_t>(*operation);
      in.bump(1);
    } else if (!in.empty() && sign + 1 != end_ && sign[1] == '=') {
      builder_.report(habit(program_, builder_.span(sign, sign + 2), "="));
      in.bump(1);
    }
    tail<g::equals>(in);
    tail<g::one_value>(in);
    builder_.finish(in.current());
  }

  /// `n++` and `n--`, with or without a blank before the signs.
  void step(Input& in, std::string_view name, std::string_view signs) {
    if (name.size() > longest_name)
      throw Stop{Reason::NameTooLong, name.data()};
    auto& statement = builder_.begin(Kind::Assign, builder_.span(name.data(), name.data()));
    statement.operation = static_cast<std::uint8_t>(*spec::find_operator(signs.front()));
    builder_.leaf(NodeKind::Name, 0, static_cast<std::int32_t>(builder_.intern(span(name))),
                  span(name));
    builder_.expression(ItemKind::Place);
    builder_.leaf(NodeKind::Number, 0, 1, span(signs));
    builder_.expression(ItemKind::Expression);
    const bool apart = name.data() + name.size() != signs.data();
    builder_.report(
        habit(program_, span(signs), fmt::format("{}{}= 1", apart ? "" : " ", signs.front())));
    in.bump(static_cast<std::size_t>(signs.data() + signs.size() - in.current()));
    builder_.finish(in.current());
  }

  void call(Input& in, std::string_view name, char next) {
    begin(in, Kind::Call, name);
    builder_.statement().word = {};
    set_name(name);
    if (next == '(') {
      builder_.open(in.current());
      in.bump(1);
      tail<g::gap>(in);
      if (in.empty() || *in.current() != ')')
        tail<g::values>(in);
      tail<g::group_end>(in);
      builder_.close();
      skip_blanks(in);
    } else if (!at_end(in) && !find_word(peek_name(in)).is(Keyword::Else)) {
      throw Stop{Reason::NakedArguments, in.current()};
    }
    builder_.finish(in.current());
  }

  bool do_line(Input& in, std::string_view name) {
    do_lines_.push_back(
        {static_cast<std::uint32_t>(program_.statements.size()), program_.diagnostics.size()});
    bare(in, Kind::Loop, name);
    const auto after = peek_name(in);
    const bool until = find_word(after).is(Keyword::Until);
    if (until || find_word(after).is(Keyword::While)) {
      builder_.statement().kind = Kind::While;
      in.bump(after.size());
      skip_blanks(in);
      condition(in, builder_.span(name.data(), after.data() + after.size()), !until, "while");
    } else if (at_end(in)) {
      builder_.report(habit(program_, span(name), "loop"));
    } else {
      throw Stop{Reason::NotAStatement, name.data()};
    }
    return true;
  }

  /// `var x = 1`, `let x = 1`, `call sub` and `dim a[3]`.
  bool declaration(Input& in, std::string_view name, Position position) {
    const Span word{span(name).begin, builder_.span(name.data(), name.data() + name.size()).end};
    in.bump(name.size());
    skip_blanks(in);
    const auto target = peek_name(in);
    if (target.empty() || find_word(target).kind != WordKind::Name)
      throw Stop{Reason::NotAStatement, name.data()};
    const auto* after = target.data() + target.size();
    while (after != end_ && is_blank(*after))
      ++after;
    for (const auto* const again :
         {"var", "let", "call", "dim"}) // one after another is no statement
      if (equal_words(target, again) && after != end_ && begins_name(*after))
        throw Stop{Reason::NotAStatement, name.data()};
    if (!equal_words(name, "dim")) {
      builder_.report(habit(program_, {word.begin, span(target).begin}, " "));
      statement(in, position);
      return true;
    }
    builder_.report(habit(program_, word, "array"));
    builder_.begin(Kind::Array, word);
    tail<g::array>(in);
    builder_.finish(in.current());
    return true;
  }

  /// What a word of another language begins, where that is a sub or a function.
  static std::optional<Kind> foreign_routine(std::string_view word) {
    for (const auto* const sub : {"procedure", "proc", "def", "void"})
      if (equal_words(word, sub))
        return Kind::Sub;
    return equal_words(word, "func") ? std::optional(Kind::Function) : std::nullopt;
  }

  /// `procedure name` and the like.
  bool routine_line(Input& in, std::string_view name, Kind kind, Position position) {
    const auto* after = name.data() + name.size();
    while (after != end_ && is_blank(*after))
      ++after;
    if (after == end_ || !begins_name(*after))
      return false; // a call of a sub that has this name
    only_on_line(position, name);
    builder_.report(habit(program_, span(name), kind == Kind::Sub ? "sub" : "function"));
    simple<g::routine>(in, kind, name);
    return true;
  }

  /// Statements of other languages; what has one meaning is taken with a finding.
  bool foreign(Input& in, std::string_view name, Position position) {
    const auto is = [&](std::string_view word) { return equal_words(name, word); };
    const auto ended = is("wend")                              ? std::string_view("while")
                       : equal_words(name.substr(0, 3), "end") ? name.substr(3)
                                                               : std::string_view();
    if (const auto end = end_of_block(ended)) {
      only_on_line(position, name);
      builder_.report(habit(program_, span(name), words_of_end(*end)));
      bare(in, *end, name);
      return true;
    }
    if (is("elif") || is("elsif")) {
      only_on_line(position, name);
      builder_.report(habit(program_, span(name), "elseif"));
      conditional(in, Kind::ElseIf, name);
      return true;
    }
    if (is("break")) {
      builder_.report(habit(program_, span(name), "exit"));
      bare(in, Kind::Exit, name);
      return true;
    }
    if (is("do")) {
      only_on_line(position, name);
      return do_line(in, name);
    }
    if (is("var") || is("let") || is("call") || is("dim"))
      return declaration(in, name, position);
    if (const auto routine = foreign_routine(name))
      return routine_line(in, name, *routine, position);
    return false;
  }

  Program& program_;
  Builder builder_;
  const char* base_;
  const char* begin_;
  const char* end_;
  std::vector<Do> do_lines_; ///< without their `loop` yet
  bool numbered_ = false;    ///< a line with a number has been seen
};

} // namespace

void parse(Program& program, std::string name, std::string path, std::string_view text) {
  File file;
  file.name = std::move(name);
  file.path = std::move(path);
  file.begin = static_cast<std::uint32_t>(program.text.size());
  program.text.append(text.substr(0, text.find('\0')));
  file.end = static_cast<std::uint32_t>(program.text.size());
  program.text += '\n'; // a place after the last byte
  file.statements_begin = static_cast<std::uint32_t>(program.statements.size());
  program.statements.reserve(program.statements.size() + text.size() / 16);
  program.items.reserve(program.items.size() + text.size() / 12);
  program.nodes.reserve(program.nodes.size() + text.size() / 6);
  const auto* const begin = program.text.data() + file.begin;
  Lines(program, begin + byte_order_mark_size(text), program.text.data() + file.end).parse();
  file.statements_end = static_cast<std::uint32_t>(program.statements.size());
  link_blocks(program, file);
  program.files.push_back(std::move(file));
}

const File& Program::file_at(std::uint32_t offset) const {
  const auto next =
      std::upper_bound(files.begin(), files.end(), offset,
                       [](std::uint32_t at, const File& file) { return at < file.begin; });
  return next == files.begin() ? files.front() : *std::prev(next);
}

} // namespace orb::structured
