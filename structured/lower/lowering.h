#pragma once

// Lowers a program to lines of the robot in one pass over its statements, in lower_*.cpp.

#include "structured/lower/code.h"
#include "structured/lower/lowering_plan.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace orb::structured::lowering {

/// The outcome of the condition for which a jump is taken.
enum class When : std::uint8_t { Holds, Fails };

/// Seconds while the values of `sleep` are read.
enum class Unit : std::uint8_t { Milliseconds, Seconds };

/// Lowers a program to lines of the robot: see lower.h. Large because each kind of statement and
/// expression has its own member, and all of them write to one list of lines and share one stack of
/// values.
class Lowering {
public:
  Lowering(const Program& program, const Names& names, const Plan& plan)
      : program_(program), names_(names), plan_(plan), variable_of_(names.symbols.size(), none),
        result_of_(names.routines.size(), none) {
    code_.routines.assign(names.routines.size(), none);
    code_.terms.reserve(2 * program.nodes.size());
  }

  Code run();

private:
  /// A routine being lowered: on its own, or inlined into its caller.
  struct RoutineContext {
    std::uint32_t routine = 0;
    std::uint32_t return_label = none;                           ///< none: a `return` of the robot
    std::vector<std::pair<std::uint32_t, std::uint32_t>> labels; ///< source names and their labels
    std::size_t loops = 0;                                       ///< loops open at its start
  };
  struct Loop {
    std::uint32_t exit;
    std::uint32_t again;
  };

  /// True if there are far more lines than fit into any area.
  bool full() const {
    constexpr std::size_t most_lines = 60000;
    return code_.lines.size() > most_lines;
  }
  const Statement& at(std::uint32_t i) const { return program_.statements[i]; }
  const Item& item(const Statement& statement, std::uint32_t n) const {
    return program_.items[statement.items_begin + n];
  }
  static std::uint32_t size(const Statement& statement) {
    return statement.items_end - statement.items_begin;
  }

  // ---- lines

  CodeLine& emit(LineKind kind);
  std::uint32_t new_label() { return code_.labels++; }
  void label(std::uint32_t label) { emit(LineKind::Label).label = label; }
  void go(std::uint32_t label) { emit(LineKind::Goto).label = label; }
  void let(std::uint32_t variable, std::uint32_t term);
  std::uint32_t into_temporary(std::uint32_t term);
  /// Stores a term in a temporary and returns a read of it, with the term's source span.
  std::uint32_t read_temporary(std::uint32_t term);
  std::uint32_t written_as(Span source, std::uint32_t term);
  /// A term that keeps its current value.
  std::uint32_t kept(std::uint32_t term);
  void go_if(Comparison comparison, std::uint32_t left, std::uint32_t right, std::uint32_t label);
  std::uint32_t variable_of(std::uint32_t symbol);

  // ---- values: a stack of terms not computed yet

  void push(std::uint32_t term) { pending_.push_back(term); }
  std::uint32_t pop();

  /// Computes the terms on the stack that must come before something with these effects, and the
  /// terms that must come before those.
  void settle(std::uint8_t effects);

  /// Computes every term that a call could change, up to `end`.
  void settle_calls(std::size_t end);
  bool is_result(std::uint32_t variable) const;
  std::uint32_t spill(std::uint32_t term);
  std::uint32_t binary(spec::Operator op, std::uint32_t left, std::uint32_t right);
  std::uint32_t call(spec::Function function, std::uint32_t operand);

  /// Pushes the value of an expression.
  void push_value(std::uint32_t root, Unit unit = Unit::Milliseconds);
  std::uint32_t value(std::uint32_t root, Unit unit = Unit::Milliseconds);
  void push_node(std::uint32_t n, Unit unit);
  std::uint32_t name(std::uint32_t symbol);

  /// min and max: keeps the first operand if `keeps` holds between it and the second.
  void push_choice(Comparison keeps);
  struct Choice {
    Comparison keeps = Comparison::Equal;
    std::uint32_t first = none; ///< terms
    std::uint32_t second = none;
    std::uint32_t result = none; ///< a variable
    std::size_t end = 0;         ///< of the lines that compute it
  };

  /// Sets the index to an element of an array and checks its bounds: an index out of bounds becomes
  /// 0, at which the robot stops.
  void point_at(std::uint32_t array, std::uint32_t index);

  // ---- calls

  void push_call(std::uint32_t n);
  std::uint32_t result(std::uint32_t routine);

  /// Calls a routine with the topmost values of the stack.
  void call_routine(std::uint32_t routine, std::size_t count);
  void routine(std::uint32_t routine);
  void body(std::uint32_t routine);

  // ---- statements

  void block(std::uint32_t from, std::uint32_t to);

  /// Lowers a statement, or a block with its contents; returns the next statement.
  std::uint32_t statement(std::uint32_t i);
  std::uint32_t user_label(std::uint32_t name);
  void call_statement(std::uint32_t i, const Statement& node);
  void leave(const Statement& node);
  void assign(const Statement& node);
  void assign_element(const Statement& node, std::uint32_t place, std::uint32_t root);
  void add_part(PartKind kind, std::uint32_t value, Span text = {});
  void add_text(Span text);
  std::uint32_t parts_now() const { return static_cast<std::uint32_t>(code_.parts.size()); }
  void print(const Statement& node);
  void finish(CodeLine& line, std::uint32_t begin);
  void perform(spec::Statement robot, std::uint32_t begin);
  void robot(const Statement& node);
  void colour(const Statement& node);
  void sleep(const Statement& node);
  void read(const Statement& node);
  void add_target(std::uint32_t place);
  void input(const Statement& node);

  // ---- conditions

  /// Jumps to `label` if the condition holds, or if it fails; otherwise falls through.
  void branch(std::uint32_t root, When when, std::uint32_t label);
  void compare(Comparison comparison, std::uint32_t left, std::uint32_t right, When when,
               std::uint32_t label);

  /// Lowers a relation with `min` or `max` on one side: `max(a, b) > c` is `a > c or b > c`.
  /// Returns false if it has neither.
  bool branch_choice(std::uint32_t root, When when, std::uint32_t label);

  /// Lowers operands joined by the same word from left to right, with short circuit.
  void branch_chain(std::uint32_t root, When when, std::uint32_t label);

  // ---- blocks

  std::uint32_t conditional(std::uint32_t i);

  template <typename Body>
  void in_loop(std::uint32_t exit, std::uint32_t again, Body write) {
    loops_.push_back({exit, again});
    write();
    loops_.pop_back();
  }

  std::uint32_t while_loop(std::uint32_t i);
  std::uint32_t repeat_until(std::uint32_t i);
  std::uint32_t endless(std::uint32_t i);
  std::uint32_t repeat_times(std::uint32_t i);
  std::uint32_t counting(std::uint32_t i);

  /// Emits the robot's own loop, which runs its body once before it tests the end.
  void native(std::uint32_t i, std::uint32_t end, std::uint32_t counter, std::uint32_t first,
              std::uint32_t last, std::int32_t step, std::uint32_t exit, std::uint32_t again);
  std::uint32_t selection(std::uint32_t i);
  void add_cases(const Statement& node, std::uint32_t body, std::vector<Case>& cases) const;

  const Program& program_;
  const Names& names_;
  const Plan& plan_;
  Code code_;
  std::vector<std::uint32_t> variable_of_;           ///< of each symbol
  std::vector<std::uint32_t> result_of_;             ///< of each routine
  std::vector<std::uint32_t> called_;                ///< routines to lower separately
  std::unordered_map<std::string_view, Span> texts_; ///< equal texts are stored once
  std::vector<std::uint32_t> pending_;
  Choice last_choice_;
  std::vector<RoutineContext> contexts_;
  std::vector<Loop> loops_;
  std::uint32_t origin_ = 0;
  std::uint32_t expansion_ = 0; ///< the current expansion
  std::uint32_t written_ = 0;   ///< the routine being written
};

} // namespace orb::structured::lowering
