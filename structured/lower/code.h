#pragma once

// The intermediate representation of a program: lines of orbBasic whose variables have no letters
// and whose lines have no numbers yet. Terms are trees in one array; lines refer to them, to labels
// and to variables by index. Lowering makes it, each pass of the optimiser rewrites it, the last
// stages print it.

#include "base/source.h"
#include "compiler/analyse/range.h"
#include "spec/basic.h"
#include "structured/text/program.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace orb::structured {

/// The variable that selects an element: the robot's Y.
inline constexpr std::uint32_t index_variable = 0;

enum class TermKind : std::uint8_t {
  Number,   ///< `value`
  Variable, ///< `left` is a variable
  Element,  ///< the selected element: the robot's Z
  System,   ///< `what` is a spec::Variable
  Binary,   ///< `what` is a spec::Operator
  Call,     ///< `what` is a spec::Function, `left` its operand
};

/// Side effects of computing a term. Two terms that share Faults or Clears must keep their order.
namespace effect {
inline constexpr std::uint8_t faults = 1;   ///< may stop the program
inline constexpr std::uint8_t clears = 2;   ///< clears what it reads, or draws a random number
inline constexpr std::uint8_t senses = 4;   ///< reads a sensor
inline constexpr std::uint8_t elements = 8; ///< reads an element
} // namespace effect

struct Term {
  TermKind kind = TermKind::Number;
  std::uint8_t what = 0;
  std::uint8_t levels = 0;  ///< nesting of parentheses and functions when printed
  std::uint8_t effects = 0; ///< bits of `effect`
  std::uint16_t size = 1;   ///< nodes of the tree
  std::uint32_t left = none;
  std::uint32_t right = none;
  std::int32_t value = 0;
  Span source; ///< the source text; empty for a generated term
};

struct Relation {
  Comparison comparison = Comparison::Equal;
  std::uint32_t left = none; ///< terms
  std::uint32_t right = none;
  compiler::Range left_range; ///< the range of the values
  compiler::Range right_range;
};

enum class Glue : std::uint8_t { None, And, Or };

struct Condition {
  Relation first;
  Relation second;
  Glue glue = Glue::None;
};

enum class LineKind : std::uint8_t {
  Nothing,    ///< removed
  Label,      ///< `label`
  Let,        ///< `variable` = `term`
  SetElement, ///< element = `term`
  SetSystem,  ///< spec::Variable `variable` = `term`
  Goto,       ///< `label`
  If,         ///< to `label` if `condition` holds
  For,        ///< `variable` from `term` to `end` by `step`; `label` follows it
  Next,       ///< `variable`; to `label` while within the end
  Gosub,      ///< `label` of routine `variable`
  Return,
  Switch, ///< by `variable`: cases; `label` if none matches
  On,     ///< `term` selects one of the labels in its parts
  Print,  ///< parts
  Do,     ///< `robot` with its parts
  Choice, ///< `condition`, then line `term`, else line `end` (or none) of `branches`
};

enum class PartKind : std::uint8_t {
  Term,      ///< `value`
  Character, ///< `$` term `value`
  Text,      ///< `text`, without quotes
  Blank,     ///< `,` of a print
  Open,      ///< `;` at the end of a print
  Variable,  ///< to assign: `value`
  Element,   ///< to assign
  Label,     ///< `value`
  Restart,   ///< the number of the first line
};

struct Part {
  PartKind kind = PartKind::Term;
  std::uint32_t value = none;
  Span text;
  compiler::Range range; ///< Term: the range of the value
};

struct Case {
  std::int32_t lo = 0;
  std::int32_t hi = 0;
  std::uint32_t label = none;
};

struct CodeLine {
  LineKind kind = LineKind::Nothing;
  spec::Statement robot = spec::Statement::End;
  bool guard = false;  ///< an index check; may be removed only if the index is proven
  bool proven = false; ///< SetElement: the index is certainly valid on the robot
  std::uint16_t routine = 0;
  std::uint32_t expansion = 0; ///< for an inlined sub; 0: none
  std::uint32_t origin = 0;    ///< its source statement
  std::uint32_t variable = none;
  std::uint32_t label = none;
  std::uint32_t term = none;
  std::uint32_t end = none;
  std::int32_t step = 1;
  std::uint32_t condition = none;
  std::uint32_t parts_begin = 0; ///< Switch: in `cases`
  std::uint32_t parts_end = 0;
};

struct CodeVariable {
  std::uint32_t symbol = none; ///< none: a temporary
  bool kept = false;           ///< may be inspected at any time
};

/// A statement with an index that is out of bounds wherever it runs.
struct WrongIndex {
  std::uint32_t statement = none;
  compiler::Range index; ///< into the elements of all arrays
};

/// An inlined call.
struct Expansion {
  std::uint32_t within = 0;  ///< the enclosing expansion; 0: none
  std::uint32_t call = none; ///< the calling statement
  std::uint32_t routine = 0; ///< the inlined routine
};

struct Code {
  std::vector<Term> terms;
  std::vector<Condition> conditions;
  std::vector<CodeLine> lines;
  std::vector<CodeLine> branches; ///< the statements in `then` and `else`
  std::vector<Part> parts;
  std::vector<Case> cases;
  std::vector<CodeVariable> variables{CodeVariable{}}; ///< the index first
  std::vector<Expansion> expansions{Expansion{}};      ///< the first is none
  std::vector<std::uint32_t> routines;                 ///< of each routine its entry label, or none
  std::vector<WrongIndex> wrong_indices;               ///< found by use_values()
  std::uint32_t labels = 0;                            ///< their number
  bool too_large = false; ///< lowering gave up: no robot has room for it

  std::uint32_t add(Term term) {
    terms.push_back(term);
    return static_cast<std::uint32_t>(terms.size()) - 1;
  }
  std::uint32_t number(std::int32_t value);
  std::uint32_t read(std::uint32_t variable);
  std::uint32_t system(spec::Variable variable);
  std::uint32_t element();
  /// Makes a binary term: folds constants and avoids negative numbers after operators, which the
  /// robot cannot read.
  std::uint32_t binary(spec::Operator op, std::uint32_t left, std::uint32_t right);
  std::uint32_t call(spec::Function function, std::uint32_t operand);
  std::uint32_t copy(std::uint32_t term);
  bool is_number(std::uint32_t term) const { return terms[term].kind == TermKind::Number; }
  bool is_leaf(std::uint32_t term) const {
    return terms[term].kind == TermKind::Number || terms[term].kind == TermKind::Variable;
  }
  std::uint32_t new_variable() {
    variables.push_back({});
    return static_cast<std::uint32_t>(variables.size()) - 1;
  }
};

/// True if two terms must be computed in this order.
constexpr bool ordered(std::uint8_t first, std::uint8_t second) {
  return (first & second & (effect::faults | effect::clears)) != 0;
}

/// True if a term stops the program for some value of a variable that it reads, regardless of known
/// ranges.
bool can_fault(const Code& code, std::uint32_t term, std::uint32_t variable);

/// How variables are compared: as themselves, or by the letters that hold them.
using Identity = std::function<std::uint32_t(std::uint32_t variable)>;

/// True if two terms compute the same value, provided that nothing happens in between.
bool same(const Code& code, std::uint32_t a, std::uint32_t b);

/// A value as a sum of a term, or none, and a number.
struct Sum {
  std::uint32_t base = none;
  std::int64_t number = 0;
};
Sum sum_of(const Code& code, std::uint32_t term);

/// True if the line itself may stop the program; jumps and calls do not, and their targets do not
/// count.
bool may_fault(const Code& code, const CodeLine& line);

/// The nesting level of a binary term over these operands.
std::uint8_t levels_of(const Code& code, spec::Operator op, std::uint32_t left,
                       std::uint32_t right);

/// Decides if an operand of `op` is printed in parentheses. A function takes everything that
/// follows, so on the left it always is.
enum class Side : std::uint8_t { Left, Right };
bool needs_parentheses(const Term& operand, spec::Operator op, Side side);

/// True if a function is at the right end: text after it would become part of its operand.
bool ends_in_function(const Code& code, std::uint32_t term);

/// True if the operand of a function is printed in parentheses.
bool function_needs_parentheses(const Code& code, std::uint32_t operand);

/// The robot has no `<=` and `>=`. Gives the side to adjust by one so that `<` or `>` is
/// equivalent; Neither if both could wrap.
enum class Moved : std::uint8_t { Neither, Left, Right };
Moved moved_side(const Code& code, const Relation& relation);

/// Calls `visit` with a reference to each root term of a line, in evaluation order.
template <typename C, typename L, typename Visit>
void each_root(C& code, L& line, Visit visit) {
  switch (line.kind) {
  case LineKind::Let:
  case LineKind::SetElement:
  case LineKind::SetSystem:
  case LineKind::On: visit(line.term); return;
  case LineKind::For:
    visit(line.term);
    visit(line.end);
    return;
  case LineKind::If: {
    auto& condition = code.conditions[line.condition];
    visit(condition.first.left);
    visit(condition.first.right);
    if (condition.glue != Glue::None) {
      visit(condition.second.left);
      visit(condition.second.right);
    }
    return;
  }
  case LineKind::Print:
  case LineKind::Do:
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      if (code.parts[i].kind == PartKind::Term || code.parts[i].kind == PartKind::Character)
        visit(code.parts[i].value);
    return;
  case LineKind::Nothing:
  case LineKind::Label:
  case LineKind::Goto:
  case LineKind::Next:
  case LineKind::Gosub:
  case LineKind::Return:
  case LineKind::Switch:
  case LineKind::Choice: return;
  }
}

/// The side effects of computing the terms of a line.
inline std::uint8_t effects_of(const Code& code, const CodeLine& line) {
  std::uint8_t effects = 0;
  each_root(code, line, [&](std::uint32_t root) { effects |= code.terms[root].effects; });
  return effects;
}

/// True if computing the value neither stops the program nor changes anything.
constexpr bool is_pure(std::uint8_t effects) {
  return (effects & (effect::faults | effect::clears)) == 0;
}

/// Calls `visit` with each variable that a term reads; the index for an element.
template <typename Visit>
void each_read(const Code& code, std::uint32_t term, Visit visit) {
  const auto& node = code.terms[term];
  switch (node.kind) {
  case TermKind::Variable: visit(node.left); return;
  case TermKind::Element: visit(index_variable); return;
  case TermKind::Binary:
    each_read(code, node.left, visit);
    each_read(code, node.right, visit);
    return;
  case TermKind::Call: each_read(code, node.left, visit); return;
  case TermKind::Number:
  case TermKind::System: return;
  }
}

/// Replaces each term `v` that reads a variable by `put(v)`; returns the same term if nothing
/// changes.
template <typename Put>
std::uint32_t with_variables(Code& code, std::uint32_t root, Put put) {
  auto node = code.terms[root];
  if (node.kind == TermKind::Variable)
    return put(root);
  if (node.kind != TermKind::Binary && node.kind != TermKind::Call)
    return root;
  const auto before = node;
  node.left = with_variables(code, node.left, put);
  node.effects |= code.terms[node.left].effects;
  if (node.kind == TermKind::Binary) {
    node.right = with_variables(code, node.right, put);
    node.effects |= code.terms[node.right].effects;
  }
  return node.left == before.left && node.right == before.right ? root : code.add(node);
}

/// Calls `visit` with each variable that a line sets.
template <typename Visit>
void each_write(const Code& code, const CodeLine& line, Visit visit) {
  if (line.kind == LineKind::Let || line.kind == LineKind::For || line.kind == LineKind::Next)
    visit(line.variable);
  if (line.kind == LineKind::Do)
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      if (code.parts[i].kind == PartKind::Variable)
        visit(code.parts[i].value);
}

/// Calls `visit` with each variable that a line reads.
template <typename Visit>
void each_line_read(const Code& code, const CodeLine& line, Visit visit) {
  each_root(code, line, [&](std::uint32_t root) { each_read(code, root, visit); });
  if (line.kind == LineKind::Next || line.kind == LineKind::Switch)
    visit(line.variable);
  if (line.kind == LineKind::SetElement)
    visit(index_variable);
  if (line.kind == LineKind::Do)
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      if (code.parts[i].kind == PartKind::Element)
        visit(index_variable);
}

/// The number of reads of each variable.
std::vector<std::uint32_t> reads_of(const Code& code);

} // namespace orb::structured
