#include "structured/text/lines.h"

#include "structured/text/blocks.h"
#include "structured/text/messages.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <utility>

namespace orb::structured {

Lines::Lines(Program& program, const char* begin, const char* end)
    : program_(program), builder_(program), begin_(begin), end_(end) {}

void Lines::parse() {
  for (const char* p = begin_; p != end_;)
    p = parse_line(p);
}

Span Lines::span(std::string_view text) const {
  return builder_.span(text.data(), text.data() + text.size());
}

const char* Lines::parse_line(const char* p) {
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

const char* Lines::resume(const char* begin, const char* at) const {
  const char* last = at;
  while (last > begin && (is_blank(last[-1]) || is_line_end(last[-1])))
    --last;
  const bool joined = last > begin && !is_name_char(last[-1]) && last[-1] != ')' &&
                      last[-1] != ']' && last[-1] != '"';
  return find_line_end(joined && !begins_statement(last, at) ? at : last, end_);
}

bool Lines::begins_statement(const char* last, const char* at) const {
  if (std::none_of(last, at, is_line_end) || at == end_ || !begins_name(*at))
    return false;
  const char* const end = end_of_name(at, end_);
  const auto word = find_word({at, static_cast<std::size_t>(end - at)});
  return word.kind == WordKind::Statement ||
         (word.kind == WordKind::Keyword && !is_function(word) && !word.is(Keyword::Not));
}

bool Lines::at_end(const Input& in) {
  return in.empty() || is_line_end(*in.current()) || *in.current() == '\'';
}

Statement& Lines::begin(Input& in, Kind kind, std::string_view word) {
  in.bump(word.size());
  skip_blanks(in);
  return builder_.begin(kind, span(word));
}

void Lines::bare(Input& in, Kind kind, std::string_view word) {
  begin(in, kind, word);
  builder_.finish(in.current());
}

void Lines::statement(Input& in, Position position) {
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

void Lines::only_on_line(Position position, std::string_view word) const {
  if (position == Position::Branch)
    throw Stop{Reason::BlockInOneLine, word.data()};
}

void Lines::leave_line(Input& in, Kind kind, std::string_view word) {
  bare(in, kind, word);
  const auto loop = peek_name(in); // `exit for`, as elsewhere
  if (kind == Kind::Exit && leave_routine(in, word, loop))
    return;
  if (is_loop_word(loop) || equal_words(loop, "do")) {
    builder_.report(habit(program_, builder_.span(word.data(), loop.data() + loop.size()), word));
    in.bump(loop.size());
  }
}

void Lines::repeat_line(Input& in, std::string_view word) {
  begin(in, Kind::Repeat, word);
  if (!at_end(in)) {
    builder_.statement().kind = Kind::RepeatTimes;
    tail<g::one_value>(in);
  }
  builder_.finish(in.current());
}

void Lines::local_line(Input& in, std::string_view word) {
  simple<g::locals>(in, Kind::Local, word);
  while (!in.empty() && *in.current() == '=') {
    const auto name = program_.items.back();
    auto& statement = builder_.begin(Kind::Assign, {name.span.begin, name.span.begin});
    statement.word = {};
    builder_.leaf(NodeKind::Name, 0, static_cast<std::int32_t>(name.value), name.span);
    builder_.expression(ItemKind::Place);
    tail<g::equals>(in);
    tail<g::one_value>(in);
    builder_.finish(in.current());
    if (tao::pegtl::parse<g::comma, Action, Control>(in, builder_)) {
      builder_.begin(Kind::Local, builder_.span(in.current(), in.current()));
      tail<g::locals>(in);
      builder_.finish(in.current());
    }
  }
}

void Lines::next_line(Input& in, std::string_view word) {
  simple<g::counted>(in, Kind::Next, word);
  const auto begin = builder_.statement().span.begin;
  bool several = false;
  for (; !in.empty() && *in.current() == ','; several = true) {
    builder_.statement().items_end = builder_.statement().items_begin; // in whatever order
    tail<g::comma>(in);
    builder_.begin(Kind::Next, builder_.span(in.current(), in.current()));
    tail<g::place>(in);
    builder_.finish(in.current());
  }
  if (!several)
    return;
  builder_.statement().items_end = builder_.statement().items_begin;
  builder_.report(habit(program_, {begin, builder_.statement().span.end}, {}, texts::NextEach()));
}

void Lines::select_line(Input& in, std::string_view word) {
  begin(in, Kind::Select, word);
  if (equal_words(peek_name(in), "case")) {
    builder_.report(habit(program_, span(peek_name(in)), " "));
    in.bump(4);
    skip_blanks(in);
  }
  tail<g::one_value>(in);
  builder_.finish(in.current());
}

void Lines::case_line(Input& in, std::string_view word) {
  begin(in, Kind::Case, word);
  if (equal_words(peek_name(in), "else")) {
    builder_.statement().kind = Kind::Else;
    in.bump(4);
  } else {
    tail<g::case_values>(in);
  }
  builder_.finish(in.current());
}

void Lines::keyword(Input& in, Keyword keyword, std::string_view word, Position position) {
  if (keyword != Keyword::Exit && keyword != Keyword::Continue)
    only_on_line(position, word);
  switch (keyword) {
  case Keyword::Exit: leave_line(in, Kind::Exit, word); return;
  case Keyword::Continue: leave_line(in, Kind::Continue, word); return;
  case Keyword::Const: simple<g::constant>(in, Kind::Const, word); return;
  case Keyword::Local: local_line(in, word); return;
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

void Lines::conditional(Input& in, Kind kind, std::string_view word) {
  begin(in, kind, word);
  tail<g::one_value>(in);
  if (!tao::pegtl::parse<g::word_then, Action, Control>(in, builder_) &&
      !skip_foreign_end(in, " then")) {
    if (!at_end(in) || kind == Kind::If)
      throw Stop{Reason::ExpectedThen, in.current()};
  }
  builder_.finish(in.current());
}

void Lines::else_line(Input& in, std::string_view word) {
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

void Lines::robot(Input& in, spec::Statement robot, std::string_view word, Position position) {
  switch (robot) {
  case spec::Statement::If: if_line(in, word, position); return;
  case spec::Statement::For:
    only_on_line(position, word);
    simple<g::counting>(in, Kind::For, word);
    return;
  case spec::Statement::Next:
    only_on_line(position, word);
    next_line(in, word);
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

void Lines::print_line(Input& in, std::string_view word) {
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

void Lines::refuse_parentheses(const Input& in) const {
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

void Lines::if_line(Input& in, std::string_view word, Position position) {
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

void Lines::end_line(Input& in, std::string_view word, Position position) {
  in.bump(word.size());
  skip_blanks(in);
  const auto what = peek_name(in);
  auto kind = end_of_block(what);
  const auto routine = foreign_routine(what);
  const bool chooses = equal_words(what, "switch") || equal_words(what, "case");
  if (equal_words(what, "for") || chooses || routine) {
    kind = chooses                 ? Kind::EndSelect
           : !routine              ? Kind::Next
           : *routine == Kind::Sub ? Kind::EndSub
                                   : Kind::EndFunction;
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

void Lines::named(Input& in, std::string_view name, Position position) {
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
  const bool otherwise = equal_words(name, "default") && innermost() == Kind::Select;
  if (next == ':' && position == Position::Line && !otherwise) {
    begin(in, Kind::Label, name);
    builder_.statement().word = {};
    set_name(name);
    in.bump(1);
    builder_.finish(in.current());
    return;
  }
  if ((next != '(' || equal_words(name, "switch")) && foreign(in, name, position))
    return;
  call(in, name, next);
}

void Lines::set_name(std::string_view name) {
  if (name.size() > longest_name)
    throw Stop{Reason::NameTooLong, name.data()};
  builder_.statement().name = builder_.intern(span(name));
  builder_.statement().name_span = span(name);
}

void Lines::assignment(Input& in) {
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

void Lines::call(Input& in, std::string_view name, char next) {
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

} // namespace orb::structured
