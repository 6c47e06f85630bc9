#include "structured/text/lines.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "repair/tokens.h"
#include "structured/text/foreign_words.h"
#include "structured/text/link_blocks.h"
#include "structured/text/messages.h"
#include "structured/text/rules.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
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
  if (p == end_ || skip_remark(in, p))
    return in.current();
  builder_.begin_line();
  const auto mark = builder_.mark();
  const char* next = nullptr;
  try {
    if (is_digit(*p))
      return numbered(p);
    statement(in, Position::Line);
    builder_.begin_line();
    skip_blanks(in);
    while (skip_last(in, {}))
      continue;
    if (!at_end(in) && !skip_remark(in, p))
      throw ParseStop{Reason::Trailing, in.current()};
    next = in.current();
  } catch (const ParseStop& stop) {
    builder_.fail(mark, stop, p, end_);
    while (!dos_.empty() && dos_.back().statement > mark.statements)
      dos_.pop_back();
    next = resume(p, stop.begin);
  }
  note_blocks(mark.statements, {p, static_cast<std::size_t>(next - p)});
  return next;
}

void Lines::note_blocks(std::size_t from, std::string_view line) {
  for (auto i = from; i < program_.statements.size(); ++i) {
    const auto role = program_.statements[i].role();
    if (opens_block(role))
      open_.push_back(role);
    if (!closes_block(role))
      continue;
    const auto opener =
        std::find_if(open_.rbegin(), open_.rend(), [&](Kind one) { return end_of(one) == role; });
    if (opener != open_.rend())
      open_.erase(std::prev(opener.base()), open_.end());
  }
  if (builder_.statement().role() == Kind::Broken &&
      trim(line.substr(0, line.find('\''))).ends_with('{'))
    open_.push_back(Kind::Broken);
  if (open_.size() > 64) // a limit beyond practical nesting
    open_.erase(open_.begin());
}

const char* Lines::numbered(const char* p) {
  if (!numbered_)
    builder_.report(explain(program_, Reason::LineNumber, builder_.token(p, end_)));
  numbered_ = true;
  builder_.begin(Kind::Broken, builder_.span(p, p));
  return find_line_end(p, end_);
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
  if (!name.empty()) {
    if (holds("else select exit continue loop end", name) && foreign(in, name, position))
      return;
    meant(in, name, name, position);
  } else if (in.empty() || *in.current() != '}' || !foreign(in, {in.current(), 1}, position)) {
    if (in.empty() || *in.current() != '?')
      throw ParseStop{at_end(in) ? Reason::ExpectedStatement : Reason::NotAStatement, in.current()};
    print_line(in, {in.current(), 1});
  }
}

void Lines::meant(Input& in, std::string_view word, std::string_view ours, Position position) {
  const auto meant = find_word(ours);
  switch (meant.kind) {
  case WordKind::Name: named(in, word, position); return;
  case WordKind::Variable: assignment(in); return;
  case WordKind::Function: throw ParseStop{Reason::NotAStatement, word.data()};
  case WordKind::Keyword: keyword(in, static_cast<Keyword>(meant.index), word, position); return;
  case WordKind::Statement:
    robot(in, static_cast<spec::Statement>(meant.index), word, position);
    return;
  }
}

void Lines::only_on_line(Position position, std::string_view word) const {
  if (position == Position::Branch)
    throw ParseStop{Reason::BlockInOneLine, word.data()};
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
  while (!in.empty() && *in.current() == '=' && program_.items.back().kind == ItemKind::Name) {
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
  case Keyword::Exit: bare(in, Kind::Exit, word); return;
  case Keyword::Continue: bare(in, Kind::Continue, word); return;
  case Keyword::Const: simple<g::constant>(in, Kind::Const, word); return;
  case Keyword::Local: local_line(in, word); return;
  case Keyword::Array: simple<g::array>(in, Kind::Array, word); return;
  case Keyword::Use: simple<g::file>(in, Kind::Use, word); return;
  case Keyword::Include: simple<g::file>(in, Kind::Include, word); return;
  case Keyword::ElseIf: conditional(in, Kind::ElseIf, word); return;
  case Keyword::Else: bare(in, Kind::Else, word); return;
  case Keyword::While: simple<g::one_value>(in, Kind::While, word); return;
  case Keyword::Repeat: repeat_line(in, word); return;
  case Keyword::Until: simple<g::one_value>(in, Kind::Until, word); return;
  case Keyword::Loop: bare(in, Kind::Loop, word); return;
  case Keyword::Select: simple<g::one_value>(in, Kind::Select, word); return;
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
  case Keyword::Max: throw ParseStop{Reason::NotAStatement, word.data()};
  }
}

void Lines::conditional(Input& in, Kind kind, std::string_view word) {
  begin(in, kind, word);
  tail<g::one_value>(in);
  if (!tao::pegtl::parse<g::word_then, Action, Control>(in, builder_) && !skip_last(in, "then")) {
    if (!at_end(in) || kind == Kind::If)
      throw ParseStop{Reason::ExpectedThen, in.current()};
  }
  builder_.finish(in.current());
}

void Lines::robot(Input& in, spec::Statement robot, std::string_view word, Position position) {
  if (robot == spec::Statement::End) {
    end_line(in, word, position);
    return;
  }
  const auto form = spec::info(robot).form;
  if (form == spec::Form::Loop || form == spec::Form::LoopEnd)
    only_on_line(position, word);
  switch (form) {
  case spec::Form::Conditional: if_line(in, word, position); return;
  case spec::Form::Loop: simple<g::counting>(in, Kind::For, word); return;
  case spec::Form::LoopEnd: simple<g::counted>(in, Kind::Next, word); return;
  case spec::Form::Branch:
    if (robot == spec::Statement::Gosub)
      throw ParseStop{Reason::Gosub, word.data()};
    simple<g::jump>(in, Kind::Goto, word);
    return;
  case spec::Form::IndexedBranch: throw ParseStop{Reason::On, word.data()};
  case spec::Form::Output: print_line(in, word); return;
  case spec::Form::Assignment: return; // the language has no `let`
  case spec::Form::Entry:
  case spec::Form::Values:
  case spec::Form::Variables:
  case spec::Form::Arguments: break;
  }
  const bool returns = robot == spec::Statement::Return;
  begin(in, returns ? Kind::Return : Kind::Robot, word).robot =
      returns ? spec::Statement::End : robot;
  if (form == spec::Form::Entry)
    tail<g::entry>(in);
  else if (form == spec::Form::Values)
    tail<g::values>(in);
  else if (form == spec::Form::Variables)
    tail<g::places>(in);
  else if (!returns)
    tail<g::arguments>(in);
  else if (!at_end(in) && !find_word(peek_name(in)).is(Keyword::Else))
    tail<g::one_value>(in);
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
    throw ParseStop{Reason::SingleQuotes, in.current(), quote + 1};
}

void Lines::if_line(Input& in, std::string_view word, Position position) {
  if (position == Position::Branch)
    throw ParseStop{Reason::NestedIf, word.data()};
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
  const auto kind = end_of_block(what);
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
  if (foreign(in, name, position))
    return;
  if (next == ':' && position == Position::Line) {
    begin(in, Kind::Label, name);
    builder_.statement().word = {};
    set_name(name);
    in.bump(1);
    builder_.finish(in.current());
    return;
  }
  call(in, name, next);
}

void Lines::set_name(std::string_view name) {
  if (name.size() > longest_name)
    throw ParseStop{Reason::NameTooLong, name.data()};
  builder_.statement().name = builder_.intern(span(name));
  builder_.statement().name_span = span(name);
}

void Lines::assignment(Input& in) {
  builder_.begin(Kind::Assign, builder_.span(in.current(), in.current()));
  tail<g::place>(in);
  const char* const sign = in.current();
  if (!in.empty() && *sign != '=') {
    const auto operation = spec::find_operator(*sign);
    if (!operation || sign + 1 == end_ || sign[1] != '=' || *sign == '{' || *sign == '}' ||
        *sign == '&' || *sign == '|')
      throw ParseStop{Reason::ExpectedEquals, sign};
    builder_.statement().operation = static_cast<std::uint8_t>(*operation);
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
    throw ParseStop{Reason::NakedArguments, in.current()};
  }
  builder_.finish(in.current());
}

// ---- syntax of other languages

bool Lines::skip_remark(Input& in, const char* line) {
  if (in.empty() || !holds("/ # - r R", {in.current(), 1}))
    return false;
  const char* const at = in.current();
  const char* const line_end = find_line_end(at, end_);
  const std::string_view rest(at, static_cast<std::size_t>(line_end - at));
  const Foreign* row = nullptr;
  auto size = std::min<std::size_t>(rest.size(), 3) + 1;
  while (row == nullptr && --size > 0)
    row = find_foreign(Stands::Remark, rest.substr(0, size));
  if (row == nullptr)
    return false;
  const auto parts = repair::split({line, static_cast<std::size_t>(line_end - line)},
                                   repair::Language::Structured);
  if (parts.comment.empty() || (!parts.tokens.empty() && line + parts.tokens.back().at >= at))
    return false;
  auto d = structured::foreign(program_, builder_.span(at, at + size), row->languages, row->here);
  d.fix->edits = {{builder_.span(at, line_end), parts.comment}};
  const auto said = trim(rest.substr(size));
  if (!said.empty() && !parts.tokens.empty() && std::all_of(said.begin(), said.end(), is_digit))
    d.fix->safety = Safety::Unsafe; // `n # 0`: another operator, not a comment
  builder_.report(std::move(d));
  in.bump(rest.size());
  return true;
}

bool Lines::skip_last(Input& in, std::string_view instead) {
  if (in.empty())
    return false;
  const char* const sign = in.current();
  const auto* const row = find_foreign(Stands::Last, {sign, 1});
  const char* const after = std::find_if(sign, end_, [&](char c) { return c != *sign; });
  Input ahead(after, end_, "");
  skip_blanks(ahead);
  if (row == nullptr || (!at_end(ahead) && !holds("; / #", {ahead.current(), 1})))
    return false;
  builder_.report(
      structured::foreign(program_, builder_.span(sign, after), row->languages, instead));
  in.bump(static_cast<std::size_t>(ahead.current() - sign));
  return true;
}

bool Lines::foreign(Input& in, std::string_view first, Position position) {
  const char* p = first.data() + first.size();
  while (p != end_ && is_blank(*p))
    ++p;
  const auto after = peek_name(Input(p, end_, ""));
  const bool loop = equal_words(first, "loop") || (first == "}" && holds("while until", after));
  const auto* const row = find_foreign(Stands::First, loop ? "loop" : first, after);
  if (row == nullptr || find_foreign(Stands::Named, first, after) != nullptr ||
      (loop && dos_.empty()))
    return false;
  const auto inner = std::find_if(open_.rbegin(), open_.rend(),
                                  [](Kind one) { return is_loop(one) || one == Kind::Select; });
  const bool in_case = inner != open_.rend() && *inner == Kind::Select;
  auto here = row->here;
  const bool needs = here.empty() || holds("elseif select sub function array for", here);
  const bool calls = p != end_ && *p == '(' && !holds("elseif select", here);
  const bool other =
      here.empty() && first != "}" &&
      (find_word(after).kind != WordKind::Name || find_foreign(Stands::First, after) != nullptr);
  if (calls || other || (needs && at_end(Input(p, end_, ""))) ||
      (holds("default", first) && !in_case))
    return false;
  if (in_case && equal_words(first, "break")) {
    leave_case(in, first, position);
    return true;
  }
  const bool whole = !row->after.empty() && !here.empty();
  const std::string_view word(
      first.data(),
      static_cast<std::size_t>((whole ? after.data() + after.size() : first.data() + first.size()) -
                               first.data()));
  if (loop && row->after.empty())
    here = words_of_end(end_of(program_.statements[dos_.back().statement].role()));
  else if (here == block_end)
    here = open_.empty() ? std::string_view() : words_of_end(end_of(open_.back()));
  else if (equal_words(first, "def") && gives_value(p))
    here = "function";
  if (loop)
    end_do(*row);
  else if (equal_words(first, "do"))
    dos_.push_back({program_.statements.size(), program_.diagnostics.size()});
  const auto said = program_.diagnostics.size();
  const bool unknown = here.empty() && row->here == block_end; // it ends a foreign block
  builder_.report(structured::foreign(program_, span(word),
                                      unknown ? std::string_view() : row->languages, here));
  const auto end = here.starts_with("end ") ? end_of_block(here.substr(4)) : std::nullopt;
  if (end) {
    only_on_line(position, word);
    bare(in, *end, word);
  } else if (unknown) {
    bare(in, Kind::Broken, word);
    program_.diagnostics[said].fix.reset();
    if (!open_.empty())
      open_.pop_back();
  } else if (here.empty()) {
    in.bump(word.size());
    skip_blanks(in);
    statement(in, position);
  } else {
    meant(in, word, here.substr(0, here.find(" not")), position);
  }
  if (here.ends_with(" not")) {
    const Span rest{span(word).end, builder_.statement().span.end};
    program_.diagnostics[said].fix->edits = {
        {{span(word).begin, rest.end}, fmt::format("{} ({})", here, trim(program_.text_of(rest)))}};
  }
  return true;
}

void Lines::leave_case(Input& in, std::string_view word, Position position) {
  bare(in, Kind::Broken, word);
  in.bump(!in.empty() && *in.current() == ';' ? 1 : 0);
  auto d = finding(rules::ForeignWord, span(word), texts::CaseEnds());
  const char* begin = word.data();
  while (begin != begin_ && is_blank(begin[-1]))
    --begin;
  const char* const end = find_line_end(in.current(), end_);
  const bool two = std::string_view(end, static_cast<std::size_t>(end_ - end)).starts_with("\r\n");
  if (position == Position::Line && end != end_ && std::all_of(in.current(), end, is_blank))
    d.fix = single_fix(texts::RemoveLine(), builder_.span(begin, end + (two ? 2 : 1)), "",
                       Safety::Safe);
  if (d.fix)
    d.help = d.fix->title;
  builder_.report(std::move(d));
}

void Lines::end_do(const Foreign& row) {
  const auto begun = dos_.back();
  dos_.pop_back();
  auto& opener = program_.statements[begun.statement];
  if (row.after.empty() || opener.role() != Kind::Loop)
    return;
  (opener.kind == Kind::Broken ? opener.meant : opener.kind) = Kind::Repeat;
  if (const auto open = std::find(open_.rbegin(), open_.rend(), Kind::Loop); open != open_.rend())
    *open = Kind::Repeat;
  auto& said = program_.diagnostics[begun.finding];
  said = structured::foreign(program_, said.span, row.languages, "repeat");
}

bool Lines::gives_value(const char* p) const {
  while ((p = find_line_end(p, end_)) != end_) {
    Input in(p, end_, "");
    skip_lines(in);
    p = in.current();
    const auto begin = peek_name(in);
    const std::string_view line(p, static_cast<std::size_t>(find_line_end(p, end_) - p));
    if (holds("sub function def", begin))
      return false;
    const auto tokens = repair::split(line, repair::Language::Structured).tokens;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
      if (tokens[i].is_word() && equal_words(tokens[i].text, "return"))
        return true;
  }
  return false;
}

} // namespace orb::structured
