#pragma once

// The target of the grammar actions of orbBasic. Private to parse_basic.cpp.

#include "base/text/text.h"
#include "base/text/utf8.h"
#include "compiler/text/program.h"
#include "spec/basic.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace orb::compiler {

/// The depth to which the parser follows parentheses. The robot gives up far earlier; deeper levels
/// are kept so that the linter can report them.
inline constexpr std::uint8_t deepest = 32;

/// Ends the parse of a line or a branch: thrown by the rules and by Builder, caught in
/// parse_basic.cpp.
struct ParseStop {
  Reason reason;
  const char* begin;
  const char* end = nullptr; ///< null: the span is the token at `begin`
  std::uint32_t found = 0;
};

/// By ASCII character.
inline constexpr auto operator_of = [] {
  std::array<std::uint8_t, INT8_MAX + 1> table{};
  for (const auto& row : spec::operators)
    table[static_cast<std::size_t>(row.symbol)] = static_cast<std::uint8_t>(row.op);
  return table;
}();

struct NumberRead {
  std::uint32_t value = 0; ///< modulo 2^32
  bool above_integer = false;
  bool above_word = false; ///< 2^32 or more
  const char* end = nullptr;
};

/// Decides if a number with many digits exceeds an integer or a word.
inline void judge_size(std::string_view written, NumberRead& digits) {
  std::uint64_t value = 0;
  for (const char c : written) {
    value = value * 10 + static_cast<std::uint64_t>(c - '0');
    if (value > static_cast<std::uint64_t>(spec::value_of(spec::Limit::GreatestInteger))) {
      constexpr auto word = std::numeric_limits<std::uint32_t>::max();
      digits.above_integer = true;
      digits.above_word = digits.above_word || value > word;
      value &= word;
    }
  }
}

/// Reads the digits at `begin`; the text ends at `end`.
inline NumberRead read_digits(const char* begin, const char* end) {
  constexpr std::ptrdiff_t small = std::numeric_limits<std::int32_t>::digits10;
  NumberRead digits;
  const char* p = begin;
  for (; p != end && is_digit(*p); ++p)
    digits.value = digits.value * 10 + static_cast<std::uint32_t>(*p - '0');
  digits.end = p;
  if (p - begin > small)
    judge_size({begin, static_cast<std::size_t>(p - begin)}, digits);
  return digits;
}

/// A line number as written, saturated below `none`.
inline std::uint32_t line_number(const NumberRead& digits) {
  return digits.above_word ? none - 1 : std::min(digits.value, none - 1);
}

/// Stores the parse results directly in the program. Large because each thing that the grammar
/// recognises has its own member.
class Builder {
public:
  explicit Builder(Program& program) : program_(program), base_(program.text.data()) {}

  Span span(const char* begin, const char* end) const {
    return {static_cast<std::uint32_t>(begin - base_), static_cast<std::uint32_t>(end - base_)};
  }

  void leaf(NodeKind kind, std::uint8_t what, const char* begin, const char* end) {
    add(kind, what, size(program_.nodes), span(begin, end));
  }

  void number(const NumberRead& digits, const char* begin) {
    auto& node = add(NodeKind::Number, 0, size(program_.nodes), span(begin, digits.end));
    node.value = static_cast<std::int32_t>(digits.value);
    node.overflow = digits.above_integer;
  }

  /// Adds a prefix operator, or parentheses around the last operand.
  void unary(NodeKind kind, std::uint8_t what, const char* begin, const char* end) {
    add(kind, what, program_.nodes.back().first, span(begin, end)).depth = depth_;
  }

  void binary(char symbol) {
    const auto& right = program_.nodes.back();
    const auto& left = program_.nodes[right.first - 1];
    add(NodeKind::Binary, operator_of[static_cast<std::size_t>(symbol)], left.first,
        {left.span.begin, right.span.end});
  }

  void open(const char* at) {
    if (++depth_ > deepest)
      throw ParseStop{Reason::TooDeep, at, nullptr};
  }
  void close() { --depth_; }

  void item(ItemKind kind, std::uint32_t value, Span where) {
    auto& item = program_.items.emplace_back();
    item.kind = kind;
    item.value = value;
    item.span = where;
  }
  void expression(ItemKind kind) {
    item(kind, size(program_.nodes) - 1, program_.nodes.back().span);
  }
  /// Extends the span of the last item to include the `$`.
  void widen_item(const char* begin) {
    program_.items.back().span.begin = span(begin, begin).begin;
  }

  /// Begins a statement. The previous one stays the parent until `end_statement`.
  void begin_statement(spec::Statement kind, Spelling spelling, const char* begin,
                       const char* end) {
    statement_ = size(program_.statements);
    auto& statement = program_.statements.emplace_back();
    statement.kind = kind;
    statement.spelling = spelling;
    statement.items_begin = size(program_.items);
    statement.nodes_begin = size(program_.nodes);
    statement.word = span(begin, end);
    statement.span.begin = statement.word.begin;
    kind_ = kind;
  }
  void spell(Spelling spelling) { program_.statements[statement_].spelling = spelling; }
  spec::Statement kind() const { return kind_; }

  /// The sizes to truncate to after a failed line or branch.
  struct Mark {
    std::size_t statements;
    std::size_t items;
    std::size_t nodes;
  };
  Mark mark() const {
    return {program_.statements.size(), program_.items.size(), program_.nodes.size()};
  }

  /// Replaces everything since `mark` by one statement with the robot's error.
  void fail(const Mark& mark, const ParseStop& stop, const char* begin, const char* end) {
    program_.statements.resize(mark.statements);
    program_.items.resize(mark.items);
    program_.nodes.resize(mark.nodes);
    auto& statement = program_.statements.emplace_back();
    statement.error = error_of(stop.reason);
    statement.items_begin = statement.items_end = size(program_.items);
    statement.span = span(begin, end);
    const auto line = size(program_.lines) - 1;
    if (program_.faults.empty() || program_.faults.back().line != line)
      program_.faults.push_back(
          {stop.reason, line, kind_, stop.found,
           stop.end != nullptr ? span(stop.begin, stop.end) : token(stop.begin)});
    depth_ = 0;
  }

  /// Parses the statements in `then` and `else` like a separate line.
  template <typename Parse>
  void branch(const char* begin, Parse parse) {
    const auto parent = statement_;
    const auto index = size(program_.statements);
    in_branch_ = true;
    const char* end = parse(mark());
    in_branch_ = false;
    auto& branch = program_.statements[index];
    branch.span = span(begin, trim(begin, end));
    end_items(branch);
    statement_ = parent;
    kind_ = spec::Statement::If;
    auto& owner = program_.statements[parent];
    (owner.then_branch == none ? owner.then_branch : owner.else_branch) = index;
  }
  bool in_branch() const { return in_branch_; }
  void end_condition() { end_items(program_.statements[statement_]); }
  void end_items(StatementNode& statement) const {
    statement.items_end = size(program_.items);
    statement.nodes_end = size(program_.nodes);
  }

  void begin_line() {
    depth_ = 0;
    in_branch_ = false;
    kind_ = spec::Statement::End;
  }

  const char* trim(const char* begin, const char* end) const {
    while (end != begin && is_blank(end[-1]))
      --end;
    return end;
  }

private:
  /// Constructs in place: a copy would stall on the fields just stored.
  Node& add(NodeKind kind, std::uint8_t what, std::uint32_t first, Span where) {
    auto& node = program_.nodes.emplace_back();
    node.kind = kind;
    node.what = what;
    node.first = first;
    node.span = where;
    return node;
  }

  template <typename T>
  static std::uint32_t size(const std::vector<T>& vector) {
    return static_cast<std::uint32_t>(vector.size());
  }

  static spec::BasicError error_of(Reason reason) {
    if (reason == Reason::UnknownWord)
      return spec::BasicError::UnknownStatement;
    if (reason == Reason::TooDeep)
      return spec::BasicError::ExpressionTooComplex;
    return spec::BasicError::SyntaxError;
  }

  /// The word, number, string or sign at `at`; empty at the end of a line.
  Span token(const char* at) const {
    const char* const end = base_ + program_.text.size();
    const char* p = at;
    if (p == end || *p == '\n' || *p == '\r' || *p == '\'')
      return span(trim(base_, at), trim(base_, at));
    if (is_letter(*p))
      p = std::find_if_not(p, end, [](char c) {
        return is_letter(c) || static_cast<unsigned char>(c) > 0x7F; // `zurück` is one word
      });
    else if (is_digit(*p))
      p = std::find_if_not(p, end, is_digit);
    else if (*p == '"')
      p = std::find_if(p, end, [](char c) { return c == '\n' || c == '\r'; });
    else if (std::strchr("<>!=", *p) != nullptr)
      p = std::find_if_not(p, end,
                           [](char c) { return c == '<' || c == '>' || c == '!' || c == '='; });
    else
      do
        ++p;
      while (p != end && is_utf8_tail(*p));
    return span(at, p);
  }

  Program& program_;
  const char* base_;
  std::uint32_t statement_ = 0;
  spec::Statement kind_ = spec::Statement::End;
  std::uint8_t depth_ = 0;
  bool in_branch_ = false;
};

} // namespace orb::compiler
