#pragma once

// Hand-written matching of the grammar rules that look up a word, the actions of matched rules, and
// the error if a required rule does not match. Private to structured/text.

#include "structured/text/builder.h"
#include "structured/text/grammar.h"
#include "structured/text/numeral.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

namespace orb::structured {

inline const char* find_line_end(const char* p, const char* end) {
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

/// Skips whitespace, and the break between a line and its continuation.
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

inline void add_numeral(Builder& builder, const char* begin, const char* end) {
  const auto numeral = read_numeral({begin, static_cast<std::size_t>(end - begin)});
  if (numeral.validity == Numeral::Validity::Bad)
    throw ParseStop{Reason::BadNumber, begin, end};
  if (numeral.validity == Numeral::Validity::Fraction)
    throw ParseStop{Reason::FractionOfMillisecond, begin, end};
  builder.leaf(numeral.duration ? NodeKind::Duration : NodeKind::Number, 0, numeral.value,
               builder.span(begin, end));
}

namespace grammar {

ORB_MATCH(gap) {
  if (builder.in_brackets())
    skip_lines(in);
  else
    skip_blanks(in);
  return true;
}

ORB_MATCH(join) {
  skip_lines(in);
  return true;
}

template <typename Rule, apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
void must_match(Input& in, Builder& builder, Reason reason) {
  if (!ORB_MATCHES(Rule))
    throw ParseStop{reason, in.current()};
}

/// Matches the index of an element, from its `[` to its `]`.
ORB_RULE_TEMPLATE
void match_index(Input& in, Builder& builder, Span name, std::uint32_t id) {
  builder.open(in.current());
  in.bump(1);
  static_cast<void>(ORB_MATCHES(gap)); // it always matches
  must_match<condition, A, M, Action, Control>(in, builder, Reason::ExpectedExpression);
  must_match<element_end, A, M, Action, Control>(in, builder, Reason::ExpectedBracket);
  builder.close();
  const auto end = builder.span(in.current(), in.current()).begin;
  builder.unary(NodeKind::Element, 0, {name.begin, end});
  builder.last().value = static_cast<std::int32_t>(id);
}

/// Matches the operands of a call, from its `(` to its `)`; returns their number.
ORB_RULE_TEMPLATE
std::uint16_t match_operands(Input& in, Builder& builder) {
  builder.open(in.current());
  in.bump(1);
  static_cast<void>(ORB_MATCHES(gap)); // it always matches
  std::uint16_t count = 0;
  if (in.empty() || *in.current() != ')')
    do {
      must_match<condition, A, M, Action, Control>(in, builder, Reason::ExpectedExpression);
      ++count;
    } while (ORB_MATCHES(comma));
  must_match<group_end, A, M, Action, Control>(in, builder, Reason::ExpectedParenthesis);
  builder.close();
  return count;
}

/// Matches a name of the program: a variable, an element or a call.
ORB_RULE_TEMPLATE
void match_name(Input& in, Builder& builder, std::string_view name) {
  const auto where = builder.span(name.data(), name.data() + name.size());
  if (name.size() > longest_name)
    throw ParseStop{Reason::NameTooLong, name.data(), name.data() + name.size()};
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

ORB_MATCH(named_factor) {
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
    throw ParseStop{Reason::ExpectedOperand, in.current()};
  const auto count = match_operands<A, M, Action, Control>(in, builder);
  if (count != (pair ? 2 : 1))
    throw ParseStop{pair ? Reason::ExpectedTwo : Reason::ExpectedOne, name.data(),
                    name.data() + name.size()};
  const Span whole{where.begin, builder.span(in.current(), in.current()).begin};
  builder.over(!pair                   ? NodeKind::Builtin
               : word.is(Keyword::Min) ? NodeKind::Least
                                       : NodeKind::Greatest,
               word.index, first, whole);
  return true;
}

ORB_MATCH(place) {
  const auto name = peek_name(in);
  if (name.empty())
    return false;
  const auto word = find_word(name);
  const char* const end = name.data() + name.size();
  if (word.kind == WordKind::Variable) {
    if (spec::variables[word.index].access != spec::Access::ReadWrite)
      throw ParseStop{Reason::ReadOnly, name.data(), end};
    builder.leaf(NodeKind::System, word.index, 0, builder.span(name.data(), end));
    in.bump(name.size());
  } else if (word.kind != WordKind::Name) {
    throw ParseStop{Reason::Reserved, name.data(), end};
  } else {
    match_name<A, M, Action, Control>(in, builder, name);
    if (builder.last().kind == NodeKind::Call)
      throw ParseStop{Reason::ExpectedPlace, name.data(), in.current()};
  }
  builder.expression(ItemKind::Place);
  return ORB_MATCHES(gap);
}

ORB_MATCH(new_name) {
  const auto name = peek_name(in);
  if (name.empty())
    return false;
  const char* const end = name.data() + name.size();
  if (find_word(name).kind != WordKind::Name)
    throw ParseStop{Reason::Reserved, name.data(), end};
  if (name.size() > longest_name)
    throw ParseStop{Reason::NameTooLong, name.data(), end};
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

ORB_MATCH(arguments) {
  const auto robot = builder.statement().robot;
  const auto& row = spec::info(robot);
  const auto most = row.parameters().size();
  const bool sleeps = robot == spec::Statement::Sleep;
  // `RGB` accepts one colour, `sleep` its duration alone.
  const std::size_t least = sleeps || robot == spec::Statement::Rgb ? 1 : row.required;
  if (robot == spec::Statement::Rgb && !in.empty() && *in.current() == '#') {
    std::uint32_t colour = 0;
    const char* const begin = in.current();
    const char* const end = end_of_name(begin + 1, in.end());
    const auto read = std::from_chars(begin + 1, end, colour, 16);
    if (end - begin != 7 || read.ptr != end)
      throw ParseStop{Reason::BadNumber, begin, end};
    builder.item(ItemKind::Colour, colour, builder.span(begin, end));
    in.bump(7);
    skip_blanks(in);
    return true;
  }
  for (std::size_t n = 0; n < most; ++n) {
    if (n > 0 && !ORB_MATCHES(comma)) {
      if (n >= least)
        return true;
      throw ParseStop{Reason::ExpectedComma, in.current()};
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
    throw ParseStop{Reason::TooManyArguments, in.current()};
  return true;
}

} // namespace grammar

namespace g = grammar;

/// The error if a required rule does not match.
template <typename Rule>
constexpr auto reason = Reason::ExpectedExpression;
ORB_REASON(Reason::ExpectedParenthesis, g::group_end)
ORB_REASON(Reason::ExpectedParenthesis, g::parameters_end)
ORB_REASON(Reason::ExpectedBracket, g::element_end)
ORB_REASON(Reason::ExpectedBracket, g::array_begin)
ORB_REASON(Reason::ExpectedEquals, g::equals)
ORB_REASON(Reason::ExpectedPlace, g::place)
ORB_REASON(Reason::ExpectedName, g::new_name)
ORB_REASON(Reason::ExpectedName, g::names)
ORB_REASON(Reason::ExpectedName, tao::pegtl::seq<g::new_name, g::gap>)
ORB_REASON(Reason::ExpectedTo, g::word_to)
ORB_REASON(Reason::ExpectedQuote, tao::pegtl::one<'"'>)
ORB_REASON(Reason::ExpectedFile, g::file_name)

ORB_CONTROL

ORB_ACTIONS

ORB_ACTION(g::numeral, add_numeral(builder, in.begin(), in.end()))
ORB_ACTION(g::group_begin, builder.open(in.begin()))
ORB_ACTION(g::group, builder.close_group(builder.span(in.begin(), in.end())))
ORB_ACTION(g::negation, builder.unary(NodeKind::Negate, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::product_tail, builder.operation(*in.begin()))
ORB_ACTION(g::sum_tail, builder.operation(*in.begin()))
ORB_ACTION(g::relation_tail, builder.relation(in.begin()))
ORB_ACTION(g::not_word, builder.open_not(in.begin()))
ORB_ACTION(g::negated, builder.close_not();
           builder.unary(NodeKind::Not, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::and_tail, builder.binary(NodeKind::And, 0))
ORB_ACTION(g::or_tail, builder.binary(NodeKind::Or, 0))
ORB_ACTION(g::expression, builder.expression(ItemKind::Expression))
ORB_ACTION(g::to_word, builder.item(ItemKind::To, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::text, builder.item(ItemKind::String, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::print_comma, builder.item(ItemKind::Comma, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::semicolon, builder.item(ItemKind::Semicolon, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::character, builder.program().items.back().kind = ItemKind::Character;
           builder.widen_item(in.begin()))

using peg::Input;

} // namespace orb::structured
