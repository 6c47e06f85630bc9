#pragma once

// An orbBasic program after parsing: flat arrays of plain records that refer to each other by
// index. Nodes are not allocated one by one, so a traversal is a walk over arrays.

#include "base/source.h"
#include "spec/basic.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace orb::compiler {

/// An index that refers to nothing.
inline constexpr std::uint32_t none = 0xFFFFFFFF;

/// The most variables of a program: the robot's 25 letters, or more for a compiled structured
/// program.
inline constexpr std::uint32_t most_letters = 64;
/// Y, which selects an element of Z.
inline constexpr std::uint32_t index_letter = spec::letter_count - 1;

enum class NodeKind : std::uint8_t {
  Number,  ///< `value`, already modulo 2^32
  Letter,  ///< `what` is 0 for A to 24 for Y, above that for names
  Indexed, ///< Z: the element that Y selects
  System,  ///< `what` is a spec::Variable
  Binary,  ///< `what` is a spec::Operator
  Group,   ///< parentheses around the operand
  Negate,  ///< a minus sign before the operand
  Call,    ///< `what` is a spec::Function
};

/// A part of an expression. An expression is a run of nodes in postfix order: operands come right
/// before their operator, the root is last. The only operand of node `i`, or the right one, is node
/// `i - 1`; the left one is the node before the first node of the right one.
struct Node {
  NodeKind kind = NodeKind::Number;
  std::uint8_t what = 0;
  std::uint8_t depth = 0;  ///< Group, Call: number of open levels, including this one
  bool overflow = false;   ///< Number: the literal is above 2 147 483 647
  std::uint32_t first = 0; ///< the first node of this subtree; a leaf's own index
  std::int32_t value = 0;
  Span span;
};

enum class ItemKind : std::uint8_t {
  Expression, ///< `value` is the root node
  Character,  ///< `$e` in print: `value` is the root node
  String,     ///< the span includes both quotes
  Comma,      ///< only in print
  Semicolon,  ///< only in print
  Letter,     ///< a variable to assign: `value` is 0 for A to 24 for Y
  Indexed,    ///< Z to assign
  System,     ///< a timer or ctrl to assign: `value` is a spec::Variable
  Target,     ///< `value` is a line number as written; 0xFFFFFFFF for a larger one
  Relation,   ///< `value` is a spec::Relation
  And,
  Or,
};

/// A part of a statement, in text order. The views below name the parts. Print holds [Expression,
/// Character, String, Comma, Semicolon…], Read [variable…], Data and all others [Expression…].
struct Item {
  ItemKind kind = ItemKind::Expression;
  std::uint32_t value = 0;
  Span span;
};

/// The spelling of a statement that has alternatives.
enum class Spelling : std::uint8_t {
  Plain,
  Let,          ///< `let v = e`
  QuestionMark, ///< `?` for print
  OnGosub,      ///< `on … gosub`; Plain is `on … goto`
};

struct StatementNode {
  spec::Statement kind = spec::Statement::End;
  Spelling spelling = Spelling::Plain;
  /// Set if the text does not parse: reaching the statement stops the program with this error
  /// before it has any effect. `kind`, items and branches are then meaningless.
  std::optional<spec::BasicError> error;
  std::uint32_t items_begin = 0;
  std::uint32_t items_end = 0;
  std::uint32_t nodes_begin = 0; ///< of all expressions in the items, in text order
  std::uint32_t nodes_end = 0;
  std::uint32_t then_branch = none; ///< If: a statement
  std::uint32_t else_branch = none; ///< If: a statement, or none
  Span word;                        ///< the statement's word; empty for `v = e`
  Span span;
};

// Named access to the parts of a statement: `program.as<ForView>(statement)`. The statement must
// have that form and no error. A view refers to the program; make it where it is needed.

struct LetView {
  static constexpr auto form = spec::Form::Assignment;
  const Item& variable;
  const Item& expression;

  explicit LetView(std::span<const Item> items) : variable(items[0]), expression(items[1]) {}
};

struct Comparison {
  const Item& left;
  const Item& relation;
  const Item& right;

  explicit Comparison(std::span<const Item> items)
      : left(items[0]), relation(items[1]), right(items[2]) {}
};

struct IfView {
  static constexpr auto form = spec::Form::Conditional;
  Comparison first;
  const Item* joint = nullptr; ///< And or Or; null for a single comparison
  std::optional<Comparison> second;

  explicit IfView(std::span<const Item> items) : first(items.first(3)) {
    if (items.size() == 3)
      return;
    joint = &items[3];
    second.emplace(items.subspan(4));
  }
  const Comparison& last() const { return second ? *second : first; }
};

struct ForView {
  static constexpr auto form = spec::Form::Loop;
  const Item& variable;
  const Item& start;
  const Item& end;
  const Item* step; ///< null if absent

  explicit ForView(std::span<const Item> items)
      : variable(items[0]), start(items[1]), end(items[2]),
        step(items.size() > 3 ? &items[3] : nullptr) {}
  const Item& last() const { return step != nullptr ? *step : end; }
};

struct NextView {
  static constexpr auto form = spec::Form::LoopEnd;
  const Item& variable;

  explicit NextView(std::span<const Item> items) : variable(items[0]) {}
};

/// `goto` and `gosub`.
struct BranchView {
  static constexpr auto form = spec::Form::Branch;
  const Item& target;

  explicit BranchView(std::span<const Item> items) : target(items[0]) {}
};

struct OnView {
  static constexpr auto form = spec::Form::IndexedBranch;
  const Item& selector;
  std::span<const Item> targets;

  explicit OnView(std::span<const Item> items) : selector(items[0]), targets(items.subspan(1)) {}
};

struct InputView {
  static constexpr auto form = spec::Form::Entry;
  const Item& variable;
  const Item* milliseconds; ///< null, like the next one, if the statement waits without limit
  const Item* fallback;

  explicit InputView(std::span<const Item> items)
      : variable(items[0]), milliseconds(items.size() > 1 ? &items[1] : nullptr),
        fallback(items.size() > 2 ? &items[2] : nullptr) {}
};

struct SleepView {
  static constexpr auto form = spec::Form::Arguments;
  const Item& seconds;
  const Item& macro;
  const Item& line;

  explicit SleepView(std::span<const Item> items)
      : seconds(items[0]), macro(items[1]), line(items[2]) {}
};

/// One line of the text. Blank lines and comment lines have neither number nor statement; `10` and
/// `10 'remark` have no statement. A line with a statement but no number holds a statement
/// with an error.
struct Line {
  std::uint32_t number = none;    ///< as written; 0xFFFFFFFE for a larger one
  std::uint32_t statement = none; ///< index into `statements`
  Span span;                      ///< without the line ending
  Span number_span;               ///< the digits
  Span comment;                   ///< from the `'` to the end of the line; empty if there is none

  bool has_number() const { return number != none; }
  bool has_statement() const { return statement != none; }
};

/// Why a piece of text does not parse: at most one reason per line.
enum class Reason : std::uint8_t {
  MissingNumber,      ///< a line without a number at its start
  BadNumber,          ///< a line number above 65535
  UnknownWord,        ///< a statement begins with an unknown word
  NotAStatement,      ///< a statement begins with something else
  ReadOnly,           ///< an assignment to a sensor
  IndexedParenthesis, ///< `Z(`
  NestedIf,
  ImpliedGoto, ///< `then 60`
  ExpectedStatement,
  ExpectedExpression,
  ExpectedVariable,
  ExpectedUserVariable,
  ExpectedEquals,
  ExpectedRelation,
  ExpectedThen,
  ExpectedTo,
  ExpectedTarget,
  ExpectedGotoOrGosub,
  ExpectedParenthesis,
  ExpectedQuote,
  ExpectedComma,
  TooManyArguments,
  TooDeep, ///< more open parentheses than the parser follows
  Trailing ///< text after a complete statement
};

struct Fault {
  Reason reason = Reason::Trailing;
  std::uint32_t line = 0;                           ///< index into `lines`
  spec::Statement statement = spec::Statement::End; ///< the enclosing statement, if one was read
  std::uint32_t found = 0;                          ///< arguments read so far, if relevant
  Span span;
};

struct Program {
  std::string_view text; ///< the parsed text; must outlive the program
  std::vector<Line> lines;
  std::vector<StatementNode> statements;
  std::vector<Item> items;
  std::vector<Node> nodes;
  std::vector<Fault> faults;
  std::uint32_t letters = spec::letter_count; ///< the number of variables; more if they have names

  std::string_view text_of(Span span) const { return text.substr(span.begin, span.size()); }
  std::span<const Item> items_of(const StatementNode& statement) const {
    return {items.data() + statement.items_begin, items.data() + statement.items_end};
  }
  template <typename View>
  View as(const StatementNode& statement) const {
    assert(!statement.error && spec::info(statement.kind).form == View::form);
    return View(items_of(statement));
  }
  /// The statement of a line and those in its branches, which follow it directly.
  std::span<const StatementNode> whole(const StatementNode& statement) const {
    const bool has_then = statement.then_branch != none;
    const bool has_else = statement.else_branch != none;
    return {&statement, std::size_t{1} + (has_then ? 1 : 0) + (has_else ? 1 : 0)};
  }
};

} // namespace orb::compiler
