#pragma once

// An orbBasic program after parsing: a few flat arrays of plain records that refer to each other by
// index. Nothing is allocated per node, so walking a program is a walk over arrays.

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

/// Stands for an index that refers to nothing.
inline constexpr std::uint32_t none = 0xFFFFFFFF;

/// How many variables a program can have: the robot's 25 letters, more where a structured program
/// is read as one.
inline constexpr std::uint32_t most_letters = 64;
/// Y, which names an element of Z.
inline constexpr std::uint32_t index_letter = spec::letter_count - 1;

enum class NodeKind : std::uint8_t {
  Number,  ///< `value`, already modulo 2^32
  Letter,  ///< `what` is 0 for A to 24 for Y, above that for names
  Indexed, ///< Z: the element that Y names
  System,  ///< `what` is a spec::Variable
  Binary,  ///< `what` is a spec::Operator
  Group,   ///< parentheses around the operand
  Negate,  ///< a minus sign before the operand
  Call,    ///< `what` is a spec::Function
};

/// A part of an expression. An expression is a run of nodes in postfix order: operands stand right
/// before what uses them, the root is the last. The only operand of node `i`, or the right one, is
/// node `i - 1`; the left one is the node before the first node of the right one.
struct Node {
  NodeKind kind = NodeKind::Number;
  std::uint8_t what = 0;
  std::uint8_t depth = 0;  ///< Group, Call: how many of them are open here, itself included
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
  Letter,     ///< a variable to be set: `value` is 0 for A to 24 for Y
  Indexed,    ///< Z to be set
  System,     ///< a timer or ctrl to be set: `value` is a spec::Variable
  Target,     ///< `value` is a line number as written, 0xFFFFFFFF for one above that
  Relation,   ///< `value` is a spec::Relation
  And,
  Or,
};

/// A part of a statement, in the order of the text. Which part means what is said by the views
/// below. Print holds [Expression, Character, String, Comma, Semicolon…], Read [variable…], Data
/// and all others [Expression…].
struct Item {
  ItemKind kind = ItemKind::Expression;
  std::uint32_t value = 0;
  Span span;
};

/// How a statement was written, where there is more than one way.
enum class Spelling : std::uint8_t {
  Plain,
  Let,          ///< `let v = e`
  QuestionMark, ///< `?` for print
  OnGosub,      ///< `on … gosub`; Plain is `on … goto`
};

struct StatementNode {
  spec::Statement kind = spec::Statement::End;
  Spelling spelling = Spelling::Plain;
  /// Set where the text does not parse: reaching the statement stops the program with this error
  /// before it has any effect. `kind`, items and branches then mean nothing.
  std::optional<spec::BasicError> error;
  std::uint32_t items_begin = 0;
  std::uint32_t items_end = 0;
  std::uint32_t nodes_begin = 0; ///< of all expressions in the items, in the order of the text
  std::uint32_t nodes_end = 0;
  std::uint32_t then_branch = none; ///< If: a statement
  std::uint32_t else_branch = none; ///< If: a statement, or none
  Span word;                        ///< the statement's word; empty for `v = e`
  Span span;
};

// The parts of a statement by their names: `program.as<ForView>(statement)`, asked only of a
// statement of that form which has no error. A view refers to the program and is made where it is
// needed.

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
  const Item* joint = nullptr; ///< And or Or; null where there is one comparison
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
  const Item* step; ///< null where none is written

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
  const Item* milliseconds; ///< null, like the next one, where the statement waits without bound
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

/// One line of the text. Blank lines and lines that hold only a comment have neither number nor
/// statement; `10` and `10 'remark` have no statement. A line with a statement but without
/// number holds a statement with an error.
struct Line {
  std::uint32_t number = none;    ///< as written, 0xFFFFFFFE for one above that
  std::uint32_t statement = none; ///< index into `statements`
  Span span;                      ///< without the line end
  Span number_span;               ///< the digits
  Span comment;                   ///< from the `'` to the end of the line; empty without comment

  bool has_number() const { return number != none; }
  bool has_statement() const { return statement != none; }
};

/// Why a piece of text does not parse: at most one for each line.
enum class Reason : std::uint8_t {
  MissingNumber,      ///< a line that does not begin with a number
  BadNumber,          ///< a line number above 65535
  UnknownWord,        ///< a statement begins with a word that is none
  NotAStatement,      ///< a statement begins with something else
  ReadOnly,           ///< a sensor is assigned to
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
  Trailing ///< something stands after a complete statement
};

struct Fault {
  Reason reason = Reason::Trailing;
  std::uint32_t line = 0;                           ///< index into `lines`
  spec::Statement statement = spec::Statement::End; ///< the statement it is in, where one was read
  std::uint32_t found = 0;                          ///< arguments read before, where that matters
  Span span;
};

struct Program {
  std::string_view text; ///< what was parsed; must outlive the program
  std::vector<Line> lines;
  std::vector<StatementNode> statements;
  std::vector<Item> items;
  std::vector<Node> nodes;
  std::vector<Fault> faults;
  std::uint32_t letters = spec::letter_count; ///< that it can use; more where variables have names

  std::string_view text_of(Span span) const { return text.substr(span.begin, span.size()); }
  std::span<const Item> items_of(const StatementNode& statement) const {
    return {items.data() + statement.items_begin, items.data() + statement.items_end};
  }
  template <typename View>
  View as(const StatementNode& statement) const {
    assert(!statement.error && spec::info(statement.kind).form == View::form);
    return View(items_of(statement));
  }
  /// The statement of a line and those in its branches, which stand right after it.
  std::span<const StatementNode> whole(const StatementNode& statement) const {
    const bool has_then = statement.then_branch != none;
    const bool has_else = statement.else_branch != none;
    return {&statement, std::size_t{1} + (has_then ? 1 : 0) + (has_else ? 1 : 0)};
  }
};

} // namespace orb::compiler
