#pragma once

// A structured program after parsing: the lines of the main file and of all included files, in flat
// arrays of plain records that refer to each other by index. Blocks are not nested records but
// links between the statements that open, divide and close them.

#include "base/diagnostic.h"
#include "base/source.h"
#include "compiler/analyse/orders.h"
#include "spec/basic.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// An index that refers to nothing.
inline constexpr std::uint32_t none = 0xFFFFFFFF;

enum class NodeKind : std::uint8_t {
  Number,   ///< `value`
  Duration, ///< `value` in milliseconds
  Name,     ///< `value` is a name: a variable, a constant, a sub without arguments
  System,   ///< `what` is a spec::Variable
  Element,  ///< `value` is the array's name, the operand its index
  Call,     ///< `value` is the function's name, `count` operands
  Builtin,  ///< `what` is a spec::Function
  Least,    ///< min(a, b)
  Greatest, ///< max(a, b)
  Negate,
  Binary,   ///< `what` is a spec::Operator
  Relation, ///< `what` is a Comparison; this and the kinds below are conditions
  Not,
  And,
  Or,
};

using Comparison = compiler::Orders;

/// A part of an expression or a condition, in postfix order: operands come right before their
/// operator. The last operand of node `i` is node `i - 1`; the one before it ends right before that
/// one's `first` node.
struct Node {
  NodeKind kind = NodeKind::Number;
  std::uint8_t what = 0;
  std::uint16_t count = 0; ///< operands of a Call
  std::uint32_t first = 0; ///< the first node of this subtree; a leaf's own index
  std::int32_t value = 0;
  Span span;

  bool is_condition() const { return kind >= NodeKind::Relation; }
};

enum class ItemKind : std::uint8_t {
  Expression, ///< `value` is the root node; may be a condition
  Place,      ///< an assignment target: `value` is a Name, Element or System node
  Character,  ///< `$e` in print
  String,     ///< the span includes both quotes
  Comma,      ///< in print
  Semicolon,  ///< in print
  Name,       ///< `value` is a name: a parameter or local, the macro of `macrun`
  To,         ///< between the ends of a range of `case`
  Colour,     ///< `value` is 0xRRGGBB, written `#RRGGBB`
  Restart,    ///< the word in `sleep`
};

struct Item {
  ItemKind kind = ItemKind::Expression;
  std::uint32_t value = 0;
  Span span;

  /// True if `value` is the root of an expression.
  bool has_nodes() const {
    return kind == ItemKind::Expression || kind == ItemKind::Place || kind == ItemKind::Character;
  }
};

enum class Kind : std::uint8_t {
  Robot,   ///< a statement of the robot with its arguments: `robot`
  Assign,  ///< [Place, Expression]; `operation` for `+=` and the like
  Print,   ///< print items
  Const,   ///< [Expression]; `name`
  Local,   ///< [Name…]
  Array,   ///< [Expression]; `name`
  Use,     ///< [String]
  Include, ///< [String]
  If,      ///< [Expression]
  ElseIf,  ///< [Expression]
  Else,    ///< of `if` and of `select`
  EndIf,   ///< has an empty span after a one-line `if`
  While,   ///< [Expression]
  EndWhile,
  Repeat,      ///< closed by Until
  Until,       ///< [Expression]
  RepeatTimes, ///< [Expression]
  EndRepeat,
  Loop,
  EndLoop,
  For,  ///< [Place, Expression, Expression, Expression step where given]
  Next, ///< [Place] or nothing
  Exit,
  Continue,
  Select, ///< [Expression]
  Case,   ///< [Expression or Expression To Expression…]
  EndSelect,
  Sub, ///< [Name…]; `name`
  EndSub,
  Function, ///< [Name…]; `name`
  EndFunction,
  Return, ///< [Expression] or nothing
  Call,   ///< [Expression…]; `name`
  Label,  ///< `name`
  Goto,   ///< `name`
  Broken, ///< a line that does not parse; a finding says why
};

struct Statement {
  Kind kind = Kind::Broken;
  spec::Statement robot = spec::Statement::End;
  std::uint8_t operation = none_operation; ///< Assign: a spec::Operator
  bool one_line = false;                   ///< If, Else, EndIf: of an `if` on one line
  Kind meant = Kind::Broken;               ///< Broken: the kind that was begun, if known
  std::uint16_t depth = 0;                 ///< the number of enclosing blocks
  std::uint32_t items_begin = 0;
  std::uint32_t items_end = 0;
  std::uint32_t name = none;
  std::uint32_t opener = none; ///< of a part or an end: the statement that opened the block
  std::uint32_t next = none;   ///< of an opener or a part: the next part or the end
  Span name_span;
  Span word; ///< empty for `v = e` and calls
  Span span;

  static constexpr std::uint8_t none_operation = 0xFF;

  /// The role among the blocks: a line that does not parse still opens or closes one.
  Kind role() const { return kind == Kind::Broken ? meant : kind; }
};

/// The part of the text and of the statements that one file contributes.
struct File {
  std::string name;        ///< as shown in findings
  std::string path;        ///< as requested
  std::uint32_t begin = 0; ///< its first byte in Program::text
  std::uint32_t end = 0;
  std::uint32_t statements_begin = 0;
  std::uint32_t statements_end = 0;
};

/// A macro made available by `use`: its name and id.
struct UsedMacro {
  std::uint32_t name = none;
  std::int32_t id = 0;
  std::uint32_t statement = none;
};

/// A file of macros, as sent to the ball before the program.
struct MacroFile {
  std::string path;
  std::string text;
};

struct Program {
  std::string text;        ///< of all files, concatenated
  std::vector<File> files; ///< the main file first
  std::vector<Statement> statements;
  std::vector<Item> items;
  std::vector<Node> nodes;
  std::vector<Span> names; ///< the first occurrence of each name; case does not count
  std::vector<UsedMacro> macros;
  std::vector<MacroFile> macro_files;
  /// Every statement once, in text order, with each file at its first `include`.
  std::vector<std::uint32_t> order;
  std::vector<Diagnostic> diagnostics;

  std::string_view text_of(Span span) const {
    return std::string_view(text).substr(span.begin, span.size());
  }
  std::string_view name(std::uint32_t index) const { return text_of(names[index]); }
  std::span<const Item> items_of(const Statement& statement) const {
    return {items.data() + statement.items_begin, items.data() + statement.items_end};
  }
  /// The root of the left sibling of `root`.
  std::uint32_t before(std::uint32_t root) const { return nodes[root].first - 1; }
  const File& file_at(std::uint32_t offset) const;
};

/// A place in one of a program's files.
struct Place {
  std::uint32_t file = 0; ///< index into Program::files
  Span span;              ///< in that file
};
Place place_of(const Program& program, Span span);

/// The findings of each file, with spans relative to that file's text, in file order.
std::vector<std::vector<Diagnostic>> findings_by_file(const Program& program);

} // namespace orb::structured
