// What other languages write, where it has one meaning here.

#include "structured/text/lines.h"

#include "structured/text/blocks.h"
#include "structured/text/messages.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::structured {

const char* Lines::numbered(const char* p) {
  if (!numbered_)
    builder_.report(explain(program_, Reason::LineNumber, builder_.token(p, end_)));
  numbered_ = true;
  builder_.begin(Kind::Broken, builder_.span(p, p));
  return find_line_end(p, end_);
}

bool Lines::skip_foreign_end(Input& in, std::string_view instead) {
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

bool Lines::skip_foreign_comment(Input& in) {
  if (in.empty())
    return false;
  const char* const p = in.current();
  const std::string_view rest(p, static_cast<std::size_t>(end_ - p));
  if (rest.starts_with("#define "))
    return false; // a constant
  const bool slashes = rest.starts_with("//");
  const bool remark = equal_words(peek_name(in), "rem");
  if (!slashes && *p != '#' && !remark)
    return false;
  const char* const line_end = find_line_end(p, end_);
  const auto sign = builder_.span(p, p + (slashes ? 2 : remark ? 3 : 1));
  const bool divided = slashes && divides(p, line_end);
  auto found = habit(program_, sign, divided ? "/" : "'");
  if (divided)
    found.fix->safety = Safety::Unsafe; // a comment may have been meant
  builder_.report(std::move(found));
  in.bump(static_cast<std::size_t>(line_end - p));
  return true;
}

bool Lines::divides(const char* sign, const char* line_end) {
  const char* before = sign;
  while (before != begin_ && is_blank(before[-1]))
    --before;
  const bool value =
      before != begin_ && (is_name_char(before[-1]) || before[-1] == ')' || before[-1] == ']');
  const char* p = sign + 2;
  while (p != line_end && is_blank(*p))
    ++p;
  const char* after = end_of_name(p, line_end);
  const auto operand = builder_.span(p, after);
  while (after != line_end && is_blank(*after))
    ++after;
  const bool known = operand.size() > 0 && (is_digit(*p) || builder_.is_known(operand));
  const bool alone =
      after == line_end || std::string_view("+-*/%").find(*after) != std::string_view::npos;
  return value && ((known && alone) || (p != line_end && *p == '(' && line_end[-1] == ')'));
}

bool Lines::leave_routine(Input& in, std::string_view word, std::string_view routine) {
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

void Lines::loop_line(Input& in, std::string_view word) {
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

void Lines::last_test(Input& in, std::string_view word, std::string_view after, bool until) {
  in.bump(after.size());
  skip_blanks(in);
  builder_.statement().kind = Kind::Until;
  const auto both = builder_.span(word.data(), after.data() + after.size());
  condition(in, both, until, "until");
}

void Lines::condition(Input& in, Span words, bool as_is, std::string_view instead) {
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
  auto turned = fmt::format("{} not ({})", instead, text);
  auto d = habit(program_, words, {}, texts::Write(turned));
  d.fix = Fix{d.help,
              {Edit{{words.begin, builder_.statement().span.end}, std::move(turned)}},
              Safety::Safe};
  builder_.report(std::move(d));
}

void Lines::step(Input& in, std::string_view name, std::string_view signs) {
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

bool Lines::do_line(Input& in, std::string_view name) {
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

bool Lines::declaration(Input& in, std::string_view name, Position position) {
  const Span word{span(name).begin, builder_.span(name.data(), name.data() + name.size()).end};
  in.bump(name.size());
  skip_blanks(in);
  const auto target = peek_name(in);
  if (target.empty() || find_word(target).kind != WordKind::Name)
    throw Stop{Reason::NotAStatement, name.data()};
  const auto* after = target.data() + target.size();
  while (after != end_ && is_blank(*after))
    ++after;
  for (const auto* const again : {"var", "let", "call", "dim"}) // one after another is no statement
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

bool Lines::gives_value(std::string_view word) const {
  std::string_view rest(word.data(), static_cast<std::size_t>(end_ - word.data()));
  for (bool first = true; !rest.empty(); first = false) {
    const auto end = std::min(rest.find_first_of("\r\n"), rest.size());
    const auto line = trim(rest.substr(0, end));
    const auto begin = line.substr(0, line.find_first_of(" \t"));
    if (!first && (holds("sub function def", begin) || equal_words(line, "end sub")))
      return false;
    const auto returns = line.find("return ");
    if (returns != std::string_view::npos || equal_words(line, "end function"))
      return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

std::optional<Kind> Lines::foreign_routine(std::string_view word) const {
  for (const auto* const sub : {"procedure", "proc", "void"})
    if (equal_words(word, sub))
      return Kind::Sub;
  if (equal_words(word, "def"))
    return gives_value(word) ? Kind::Function : Kind::Sub;
  return equal_words(word, "func") ? std::optional(Kind::Function) : std::nullopt;
}

bool Lines::routine_line(Input& in, std::string_view name, Kind kind, Position position) {
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

bool Lines::begins_cases(const Input& in) const {
  Input below(find_line_end(in.current(), end_), end_, "");
  skip_lines(below);
  return equal_words(peek_name(below), "case");
}

std::optional<Kind> Lines::innermost() const {
  int closed = 0;
  for (auto one = program_.statements.rbegin(); one != program_.statements.rend(); ++one) {
    const auto role = one->role();
    closed += closes_block(role) ? 1 : 0;
    if (!opens_block(role) || closed-- > 0)
      continue;
    closed = 0;
    if (is_loop(role) || role == Kind::Select)
      return role;
  }
  return std::nullopt;
}

bool Lines::foreign(Input& in, std::string_view name, Position position) {
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
  if (is("switch") && begins_cases(in)) {
    only_on_line(position, name);
    builder_.report(habit(program_, span(name), "select"));
    simple<g::one_value>(in, Kind::Select, name);
    return true;
  }
  if (is("default") && innermost() == Kind::Select) {
    only_on_line(position, name);
    builder_.report(habit(program_, span(name), "else"));
    bare(in, Kind::Else, name);
    return true;
  }
  if (is("break") && innermost() == Kind::Select) { // a `case` ends where the next one begins
    bare(in, Kind::Broken, name);
    if (!in.empty() && *in.current() == ';')
      in.bump(1);
    builder_.report(habit(program_, builder_.span(name.data(), in.current()), " "));
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

} // namespace orb::structured
