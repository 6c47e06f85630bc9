#include "compiler/text/parse_basic.h"

#include "base/text/utf8.h"
#include "compiler/text/basic_words.h"
#include "compiler/text/builder.h"
#include "compiler/text/grammar.h"
#include "spec/limits.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace orb::compiler {
namespace {

/// The letters of a word, one to a byte, the first one lowest.
struct PackedWord {
  std::uint64_t packed = 0;
  std::size_t length = 0;
};

/// Marks the non-letters among eight bytes in the highest bit of each.
constexpr std::uint64_t no_letters(std::uint64_t bytes) {
  constexpr std::uint64_t each = ~std::uint64_t{0} / UINT8_MAX; // a 1 in each byte
  constexpr std::uint64_t high = UINT8_MAX / 2 + 1;             // the highest bit of a byte
  constexpr std::uint64_t low = UINT8_MAX / 2;                  // the others
  const auto small = (bytes | each * ' ') & each * low;
  return (~(small + each * (high - 'a')) | (small + each * (low - 'z')) | bytes) & each * high;
}

/// Packs the letters from `p` on, one by one.
PackedWord pack_letters(const char* p, const char* end) {
  PackedWord letters;
  for (; p != end && is_letter(*p); ++p, ++letters.length)
    letters.packed |= static_cast<std::uint64_t>(*p) << (8 * (letters.length % words::longest));
  return letters;
}

/// The same, eight letters at once. If the word is longer than any known one, `packed` is
/// meaningless.
inline PackedWord pack_word(const char* p, const char* end) {
  static_assert(words::longest == sizeof(std::uint64_t));
  if (std::endian::native == std::endian::little && end - p >= std::ptrdiff_t{words::longest}) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, p, words::longest);
    if (const auto others = no_letters(bytes); others != 0) {
      const auto bits = static_cast<unsigned>(std::countr_zero(others)) & ~7U;
      return {bytes & ((std::uint64_t{1} << bits) - 1), bits / 8};
    }
  }
  return pack_letters(p, end);
}

template <typename Input>
PackedWord peek_word(const Input& in) {
  return pack_word(in.current(), in.end());
}

template <typename Input>
void skip_blanks(Input& in) {
  while (!in.empty() && is_blank(*in.current()))
    in.bump_in_this_line(1);
}

/// The end of a line's text: its line ending or the end of the text.
const char* find_line_end(const char* p, const char* end) {
  return std::find_if(p, end, [](char c) { return c == '\n' || c == '\r'; });
}

/// Finds what comes first outside strings: the `else` of an `if` whose first branch does not parse,
/// the comment, or the end of the line.
template <typename IsEnd>
const char* skip_outside_strings(const char* p, const char* end, IsEnd is_end) {
  for (bool in_string = false; p != end && *p != '\n' && *p != '\r'; ++p) {
    if (*p == '"')
      in_string = !in_string;
    if (!in_string && (*p == '\'' || is_end(p)))
      break;
  }
  return p;
}

} // namespace

namespace grammar {

ORB_MATCH(number) {
  const char* const begin = in.current();
  const auto digits = read_digits(begin, in.end());
  if (digits.end == begin)
    return false;
  builder.number(digits, begin);
  in.bump_in_this_line(static_cast<std::size_t>(digits.end - begin));
  return true;
}

ORB_MATCH(named_factor) {
  const auto letters = peek_word(in);
  if (letters.length == 0)
    return false;
  const char* const begin = in.current();
  const char* const end = begin + letters.length;
  const auto word = find_word(letters.packed, letters.length);
  switch (word.kind) {
  case WordKind::Letter: {
    const bool indexed = word.index == spec::value_of(spec::Limit::DirectVariables);
    if (indexed && end != in.end() && *end == '(')
      throw ParseStop{Reason::IndexedParenthesis, begin, end + 1};
    builder.leaf(indexed ? NodeKind::Indexed : NodeKind::Letter, word.index, begin, end);
    in.bump_in_this_line(letters.length);
    return true;
  }
  case WordKind::Variable:
    builder.leaf(NodeKind::System, word.index, begin, end);
    in.bump_in_this_line(letters.length);
    return true;
  case WordKind::Function:
    in.bump_in_this_line(letters.length);
    builder.open(begin);
    if (!ORB_MATCHES(call_operand))
      return false;
    builder.unary(NodeKind::Call, word.index, begin, builder.trim(begin, in.current()));
    builder.close();
    return true;
  case WordKind::Unknown:
  case WordKind::Statement:
  case WordKind::Particle: return false;
  }
  return false;
}

ORB_MATCH(user_variable) {
  const auto letters = peek_word(in);
  if (letters.length != 1)
    return false;
  const char* const begin = in.current();
  const auto index = find_word(letters.packed, 1).index;
  const bool indexed = index == spec::value_of(spec::Limit::DirectVariables);
  if (indexed && begin + 1 != in.end() && begin[1] == '(')
    throw ParseStop{Reason::IndexedParenthesis, begin, begin + 2};
  builder.item(indexed ? ItemKind::Indexed : ItemKind::Letter, index,
               builder.span(begin, begin + 1));
  in.bump_in_this_line(1);
  skip_blanks(in);
  return true;
}

ORB_MATCH(arguments) {
  const auto& row = spec::info(builder.kind());
  const auto& slots = row.parameter_slots; // used slots come first
  std::size_t n = 0;
  for (; n < slots.size() && !slots[n].name.empty(); ++n) {
    if (n > 0) {
      const char* const here = in.current();
      if (!ORB_MATCHES(comma)) {
        if (n >= row.required)
          return true;
        throw ParseStop{Reason::ExpectedComma, here, nullptr, static_cast<std::uint32_t>(n)};
      }
    }
    if (!ORB_MATCHES(expression))
      throw ParseStop{Reason::ExpectedExpression, in.current(), nullptr,
                      static_cast<std::uint32_t>(n)};
  }
  if (n > 0 && in.current() != in.end() && *in.current() == ',')
    throw ParseStop{Reason::TooManyArguments, in.current(), nullptr};
  return true;
}

/// Parses a branch up to `End`. A branch that does not parse ends at `else` (only a `then` branch)
/// or at the end of the line, and stores the robot's error.
template <typename End, apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Control, typename Input>
bool match_branch(Input& in, Builder& builder) {
  const char* const begin = in.current();
  builder.branch(begin, [&](const Builder::Mark& mark) {
    try {
      if (begin != in.end() && is_digit(*begin))
        throw ParseStop{Reason::ImpliedGoto, begin, nullptr};
      if (!ORB_MATCHES(statement))
        throw ParseStop{Reason::ExpectedStatement, in.current(), nullptr};
      if (!ORB_MATCHES(End))
        throw ParseStop{Reason::Trailing, in.current(), nullptr};
    } catch (const ParseStop& stop) {
      const auto at_else = [&](const char* p) {
        constexpr std::string_view word = "else";
        const auto left = static_cast<std::size_t>(in.end() - p);
        return std::is_same_v<End, then_end> && left >= word.size() &&
               std::string_view(p, word.size()) == word &&
               (left == word.size() || !is_letter(p[word.size()])) &&
               (p == begin || !is_letter(p[-1]));
      };
      const char* const end = skip_outside_strings(begin, in.end(), at_else);
      builder.fail(mark, stop, begin, builder.trim(begin, end));
      if (end > in.current())
        in.bump_in_this_line(static_cast<std::size_t>(end - in.current()));
    }
    return in.current();
  });
  return true;
}

ORB_MATCH(then_branch) {
  return match_branch<then_end, A, M, Action, Control>(in, builder);
}

ORB_MATCH(else_branch) {
  return match_branch<line_end, A, M, Action, Control>(in, builder);
}

/// `word` is the word at this position, with `length` letters.
ORB_RULE_TEMPLATE
bool match_assignment(Input& in, Builder& builder, Word word, std::size_t length) {
  const char* const begin = in.current();
  if (length > 0 && word.kind == WordKind::Variable) {
    if (spec::variables[word.index].access != spec::Access::ReadWrite)
      throw ParseStop{Reason::ReadOnly, begin, nullptr};
    builder.item(ItemKind::System, word.index, builder.span(begin, begin + length));
    in.bump_in_this_line(length);
    skip_blanks(in);
  } else if (!ORB_MATCHES(user_variable)) {
    throw ParseStop{Reason::ExpectedVariable, begin, nullptr};
  }
  return ORB_MATCHES(assignment);
}
ORB_MATCH(word_statement) {
  const auto letters = peek_word(in);
  if (letters.length == 0)
    return false;
  const char* const begin = in.current();
  const char* const end = begin + letters.length;
  const auto word = find_word(letters.packed, letters.length);
  switch (word.kind) {
  case WordKind::Unknown: throw ParseStop{Reason::UnknownWord, begin, nullptr};
  case WordKind::Function:
  case WordKind::Particle: throw ParseStop{Reason::NotAStatement, begin, nullptr};
  case WordKind::Letter:
  case WordKind::Variable:
    builder.begin_statement(spec::Statement::Let, Spelling::Plain, begin, begin);
    return match_assignment<A, M, Action, Control>(in, builder, word, letters.length);
  case WordKind::Statement: break;
  }
  const auto kind = static_cast<spec::Statement>(word.index);
  if (kind == spec::Statement::If && builder.in_branch())
    throw ParseStop{Reason::NestedIf, begin, nullptr};
  builder.begin_statement(kind, Spelling::Plain, begin, end);
  in.bump_in_this_line(letters.length);
  skip_blanks(in);
  switch (spec::info(kind).form) {
  case spec::Form::Assignment: {
    builder.spell(Spelling::Let);
    const auto name = peek_word(in);
    return match_assignment<A, M, Action, Control>(in, builder, find_word(name.packed, name.length),
                                                   name.length);
  }
  case spec::Form::Conditional: return ORB_MATCHES(conditional);
  case spec::Form::Loop: return ORB_MATCHES(loop);
  case spec::Form::LoopEnd: return ORB_MATCHES(loop_end);
  case spec::Form::Branch: return ORB_MATCHES(branch_line);
  case spec::Form::IndexedBranch: return ORB_MATCHES(indexed_branch);
  case spec::Form::Output: return ORB_MATCHES(output);
  case spec::Form::Entry: return ORB_MATCHES(entry);
  case spec::Form::Values: return ORB_MATCHES(values);
  case spec::Form::Variables: return ORB_MATCHES(variables);
  case spec::Form::Arguments: return ORB_MATCHES(arguments);
  }
  return false;
}

} // namespace grammar

namespace {

namespace g = grammar;

/// The error if a required rule does not match.
template <typename Rule>
constexpr auto reason = Reason::Trailing;
ORB_REASON(Reason::ExpectedExpression, g::sum)
ORB_REASON(Reason::ExpectedExpression, g::product)
ORB_REASON(Reason::ExpectedExpression, g::factor)
ORB_REASON(Reason::ExpectedExpression, g::positive)
ORB_REASON(Reason::ExpectedExpression, g::expression)
ORB_REASON(Reason::ExpectedParenthesis, g::group_end)
ORB_REASON(Reason::ExpectedEquals, g::equals)
ORB_REASON(Reason::ExpectedComma, g::comma)
ORB_REASON(Reason::ExpectedUserVariable, g::user_variable)
ORB_REASON(Reason::ExpectedTarget, g::target)
ORB_REASON(Reason::ExpectedTarget, tao::pegtl::seq<g::target, g::_>)
ORB_REASON(Reason::ExpectedTarget, g::targets)
ORB_REASON(Reason::ExpectedGotoOrGosub, g::on_word)
ORB_REASON(Reason::ExpectedTo, g::word_to)
ORB_REASON(Reason::ExpectedThen, g::word_then)
ORB_REASON(Reason::ExpectedRelation, g::relation_sign)
ORB_REASON(Reason::ExpectedQuote, tao::pegtl::one<'"'>)
ORB_REASON(Reason::ExpectedStatement, g::statement)

ORB_CONTROL

ORB_ACTIONS

ORB_ACTION(g::group_begin, builder.open(in.begin()))
ORB_ACTION(g::group, builder.unary(NodeKind::Group, 0, in.begin(), in.end()); builder.close())
ORB_ACTION(g::negation, builder.unary(NodeKind::Negate, 0, in.begin(), in.end()))
ORB_ACTION(g::product_tail, builder.binary(*in.begin()))
ORB_ACTION(g::sum_tail, builder.binary(*in.begin()))
ORB_ACTION(g::expression, builder.expression(ItemKind::Expression))
ORB_ACTION(g::target, builder.item(ItemKind::Target, line_number(read_digits(in.begin(), in.end())),
                                   builder.span(in.begin(), in.end())))
ORB_ACTION(g::relation_sign,
           builder.item(ItemKind::Relation,
                        static_cast<std::uint32_t>(*spec::find_relation(*in.begin())),
                        builder.span(in.begin(), in.end())))
ORB_ACTION(g::also_and, builder.item(ItemKind::And, 0, builder.span(in.begin(), in.begin() + 3)))
ORB_ACTION(g::also_or, builder.item(ItemKind::Or, 0, builder.span(in.begin(), in.begin() + 2)))
ORB_ACTION(g::word_then, builder.end_condition())
ORB_ACTION(g::text, builder.item(ItemKind::String, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::print_comma, builder.item(ItemKind::Comma, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::semicolon, builder.item(ItemKind::Semicolon, 0, builder.span(in.begin(), in.end())))
ORB_ACTION(g::character, builder.expression(ItemKind::Character); builder.widen_item(in.begin()))
ORB_ACTION(g::on_gosub, builder.spell(Spelling::OnGosub))
ORB_ACTION(g::question_mark, builder.begin_statement(spec::Statement::Print, Spelling::QuestionMark,
                                                     in.begin(), in.end()))
using peg::Input;

/// Parses the lines of a text in sequence.
class Lines {
public:
  explicit Lines(Program& program)
      : program_(program), builder_(program), begin_(program.text.data()),
        end_(begin_ + program.text.size()) {}

  void parse() {
    for (const char* p = begin_; p != end_;)
      p = after_line_end(parse_line(p));
  }

private:
  /// Skips the spaces of a line that starts at `p` and returns its begin. Concatenated texts may
  /// have a byte order mark on any line; it is skipped too.
  const char* skip_margin(const char*& p) const {
    for (const char* begin = p;; begin = p) {
      while (p != end_ && is_blank(*p))
        ++p;
      const auto mark = byte_order_mark_size({p, static_cast<std::size_t>(end_ - p)});
      if (mark == 0)
        return begin;
      p += mark;
    }
  }

  /// Parses the line that starts at `p`; returns its end.
  const char* parse_line(const char* p) {
    auto& line = program_.lines.emplace_back();
    const char* const begin = skip_margin(p);
    if (p != end_ && *p != '\n' && *p != '\r' && *p != '\'')
      p = parse_content(line, p);
    if (p != end_ && *p == '\'') {
      const char* const end = find_line_end(p, end_);
      line.comment = builder_.span(p, end);
      p = end;
    }
    line.span = builder_.span(begin, p);
    return p;
  }

  /// Parses number and statement; returns their end: a comment or the end of the line.
  const char* parse_content(Line& line, const char* begin) {
    builder_.begin_line();
    const auto mark = builder_.mark();
    const auto digits = read_digits(begin, end_);
    const char* body = digits.end;
    while (body != end_ && is_blank(*body))
      ++body;
    try {
      if (digits.end == begin)
        throw ParseStop{Reason::MissingNumber, begin, nullptr};
      line.number = line_number(digits);
      line.number_span = builder_.span(begin, digits.end);
      if (line.number > static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)))
        throw ParseStop{Reason::BadNumber, begin, digits.end};
      Input in(body, end_, "");
      tao::pegtl::parse<g::line_rest, Action, Control>(in, builder_);
      if (program_.statements.size() > mark.statements)
        finish(line, mark, body, in.current());
      return in.current();
    } catch (const ParseStop& stop) {
      const char* const end = skip_outside_strings(body, end_, [](const char*) { return false; });
      builder_.fail(mark, stop, body, builder_.trim(body, end));
      line.statement = static_cast<std::uint32_t>(mark.statements);
      return end;
    }
  }

  void finish(Line& line, const Builder::Mark& mark, const char* body, const char* end) {
    line.statement = static_cast<std::uint32_t>(mark.statements);
    auto& statement = program_.statements[mark.statements];
    statement.span = builder_.span(body, builder_.trim(body, end));
    if (statement.kind != spec::Statement::If)
      builder_.end_items(statement);
  }

  /// Skips one LF, CR or CRLF.
  const char* after_line_end(const char* p) const {
    if (p == end_)
      return p;
    return *p == '\r' && p + 1 != end_ && p[1] == '\n' ? p + 2 : p + 1;
  }

  Program& program_;
  Builder builder_;
  const char* begin_;
  const char* end_;
};

} // namespace

Program parse(std::string_view text) {
  Program program;
  program.text = text.substr(0, text.find('\0'));
  // Measured on realistic programs: about one line per 16 bytes, two nodes and two items per line.
  program.lines.reserve(text.size() / 16 + 1);
  program.statements.reserve(text.size() / 12 + 1);
  program.items.reserve(text.size() / 6 + 1);
  program.nodes.reserve(text.size() / 6 + 1);
  Lines(program).parse();
  return program;
}

} // namespace orb::compiler
