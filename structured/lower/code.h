#pragma once

// A program on its way to the robot: lines of orbBasic in which variables have no letters and lines
// no numbers yet. Terms are trees in one array; lines refer to them, to labels and to variables by
// index. Lowering writes it, each pass of the optimiser rewrites it, the last stages print it.

#include "base/source.h"
#include "compiler/analyse/range.h"
#include "spec/basic.h"
#include "structured/text/program.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace orb::structured {

/// The variable that names an element: the robot's Y.
inline constexpr std::uint32_t index_variable = 0;

enum class TermKind : std::uint8_t {
  Number,   ///< `value`
  Variable, ///< `left` is a variable
  Element,  ///< what the index names: the robot's Z
  System,   ///< `what` is a spec::Variable
  Binary,   ///< `what` is a spec::Operator
  Call,     ///< `what` is a spec::Function, `left` its operand
};

/// What computing a term does besides giving a value. Two that share Faults or Clears keep their
/// order.
namespace effect {
inline constexpr std::uint8_t faults = 1;   ///< may stop the program
inline constexpr std::uint8_t clears = 2;   ///< clears what it reads, or draws a random number
inline constexpr std::uint8_t senses = 4;   ///< reads the world
inline constexpr std::uint8_t elements = 8; ///< reads an element
} // namespace effect

struct Term {
  TermKind kind = TermKind::Number;
  std::uint8_t what = 0;
  std::uint8_t levels = 0;  ///< parentheses and functions that are open at once when it is printed
  std::uint8_t effects = 0; ///< bits of `effect`
  std::uint16_t size = 1;   ///< nodes of the tree
  std::uint32_t left = none;
  std::uint32_t right = none;
  std::int32_t value = 0;
  Span source; ///< what it was written as; empty where nobody wrote it
};

struct Relation {
  Comparison comparison = Comparison::Equal;
  std::uint32_t left = none; ///< terms
  std::uint32_t right = none;
  compiler::Range left_range; ///< what is known of the values
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
  If,         ///< to `label` where `condition` holds
  For,        ///< `variable` from `term` to `end` by `step`; `label` stands after it
  Next,       ///< `variable`; to `label` while it is within the end
  Gosub,      ///< `label` of routine `variable`
  Return,
  Switch, ///< by `variable`: cases; `label` where none fits
  On,     ///< `term` chooses among the labels in its parts
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
  Variable,  ///< is set: `value`
  Element,   ///< is set
  Label,     ///< `value`
  Restart,   ///< the number of the first line
};

struct Part {
  PartKind kind = PartKind::Term;
  std::uint32_t value = none;
  Span text;
  compiler::Range range; ///< Term: what is known of the value
};

struct Case {
  std::int32_t lo = 0;
  std::int32_t hi = 0;
  std::uint32_t label = none;
};

struct CodeLine {
  LineKind kind = LineKind::Nothing;
  spec::Statement robot = spec::Statement::End;
  bool guard = false;  ///< of the test of an index: may only be removed where the index is proven
  bool proven = false; ///< SetElement: the index is certainly one of the robot's
  std::uint16_t routine = 0;
  std::uint32_t expansion = 0; ///< of a sub that is written into its caller; 0: none
  std::uint32_t origin = 0;    ///< the statement that it is for
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
  bool kept = false;           ///< somebody may look at it at any time
};

/// A statement whose index is outside of its array wherever it runs.
struct WrongIndex {
  std::uint32_t statement = none;
  compiler::Range index; ///< among the elements of all arrays
};

/// A call in whose place the sub itself is written.
struct Expansion {
  std::uint32_t within = 0;  ///< the expansion that the call stands in; 0: none
  std::uint32_t call = none; ///< the statement that calls
  std::uint32_t routine = 0; ///< what it calls
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
  std::uint32_t labels = 0;                            ///< how many there are
  bool too_large = false; ///< lowering gave up: no robot holds such a program

  std::uint32_t add(Term term) {
    terms.push_back(term);
    return static_cast<std::uint32_t>(terms.size()) - 1;
  }
  std::uint32_t number(std::int32_t value);
  std::uint32_t read(std::uint32_t variable);
  std::uint32_t system(spec::Variable variable);
  std::uint32_t element();
  /// With constants folded, and written as the robot can: no negative numbers after operators.
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

/// Whether two terms, one computed before the other, must keep that order.
constexpr bool ordered(std::uint8_t first, std::uint8_t second) {
  return (first & second & (effect::faults | effect::clears)) != 0;
}

/// Whether a term stops the program for some values of a variable that it reads, whatever is known
/// of it.
bool can_fault(const Code& code, std::uint32_t term, std::uint32_t variable);

/// What two variables are compared by: themselves, or the letters that hold them.
using Identity = std::function<std::uint32_t(std::uint32_t variable)>;

/// Whether two terms compute the same from the same variables, if nothing happens in between.
bool same(const Code& code, std::uint32_t a, std::uint32_t b);

/// A value as a sum: a term, or none, and a number.
struct Sum {
  std::uint32_t base = none;
  std::int64_t number = 0;
};
Sum sum_of(const Code& code, std::uint32_t term);

/// Whether a line may stop the program; jumps and calls themselves do not, nor does what they lead
/// to count.
bool may_fault(const Code& code, const CodeLine& line);

/// The levels of a binary term over these operands.
std::uint8_t levels_of(const Code& code, spec::Operator op, std::uint32_t left,
                       std::uint32_t right);

/// Whether an operand of `op` is printed in parentheses. A function takes all that follows,
/// so it is always in parentheses on the left.
enum class Side : std::uint8_t { Left, Right };
bool needs_parentheses(const Term& operand, spec::Operator op, Side side);

/// Whether a function stands at the right end: what follows would become part of its operand.
bool ends_in_function(const Code& code, std::uint32_t term);

/// Whether the operand of a function is printed in parentheses.
bool function_needs_parentheses(const Code& code, std::uint32_t operand);

/// The comparison that holds where `comparison` does not, and the one with its sides swapped.
Comparison opposite(Comparison comparison);
Comparison mirrored(Comparison comparison);

/// The orders of two values in which a comparison holds, as bits: less, equal, greater.
unsigned orders_of(Comparison comparison);

/// The robot has no `<=` and `>=`: which side of such a comparison gets a 1 added or taken away, so
/// that `<` or `>` says the same. Neither where both could wrap.
enum class Moved : std::uint8_t { Neither, Left, Right };
Moved moved_side(const Code& code, const Relation& relation);

/// Calls `visit` with a reference to each root term of a line, in the order of their evaluation.
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

/// What computing the terms of a line does.
inline std::uint8_t effects_of(const Code& code, const CodeLine& line) {
  std::uint8_t effects = 0;
  each_root(code, line, [&](std::uint32_t root) { effects |= code.terms[root].effects; });
  return effects;
}

/// Whether computing something neither stops the program nor changes what is read.
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

/// A term with `put(v)` in place of each term `v` that reads a variable; itself where all stay.
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

/// Of each variable: how often it is read.
std::vector<std::uint32_t> reads_of(const Code& code);

} // namespace orb::structured
