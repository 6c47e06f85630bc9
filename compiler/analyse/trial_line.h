#pragma once

#include "base/diagnostic.h"
#include "compiler/analyse/trial_moment.h"
#include "compiler/analyse/trial_run.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orb::compiler {

/// The effect of a line on the state, and the values that stop the program.
class TrialLine {
public:
  TrialLine(const Program& program, const Flow& flow)
      : program_(program), flow_(flow), known_(program.nodes.size()), runs_(flow.code.size()) {}

protected:
  /// Records that the program stops here.
  void stop(const Rule& rule, Span span, Message message, Message help = {});
  /// Records that some of the values here stop the program: those of numbers and chance.
  void warn(Span span, Message message, Message help = {});
  /// Adds a fault, unless its place has one as certain.
  void add(TrialFault fault);
  /// The round of the enclosing loop; 0 outside a loop, in nested loops, and if the line does not
  /// run in every round.
  std::uint32_t round() const;
  /// The first line of the only enclosing loop; none if there is not exactly one.
  std::uint32_t only_loop() const;
  void stop_at(Span span, Message allowed, const Range& range, Message help = {});

  // ---- values

  const Value& value(const Item& item);
  Value compute(const Node& node, std::uint32_t index);
  /// True if a value takes one outside of a range for certain, in some run.
  static bool may_leave(const Value& value, std::int64_t least, std::int64_t greatest);
  void check_operand(const spec::FunctionInfo& row, Span span, const Value& operand);
  void check_right(spec::Operator op, Span span, const Value& operand);
  /// The element selected by Y, if that is known; reports an index that stops the program.
  Value* selected(Span span);
  /// The same without a report.
  Value* element_at_index();
  /// The variable that a node reads, if it is known.
  Value* variable_of(const Node& node);
  /// Calls `visit` with each variable that an expression reads and that has several values; all
  /// elements if the index is unknown.
  template <typename Visit>
  void each_variable(const Item& expression, Visit visit) {
    for (auto n = program_.nodes[expression.value].first; n <= expression.value; ++n) {
      const auto& node = program_.nodes[n];
      auto* const one = variable_of(node);
      if (one != nullptr && !one->range.constant())
        visit(*one);
      else if (one == nullptr && node.kind == NodeKind::Indexed)
        for (auto& any : now_.elements)
          visit(any);
    }
  }
  Value element(Span span);
  void check_value(const Item& item, std::string_view word, const spec::Parameter& parameter);
  std::string in_parentheses(const Item& item) const;
  void set(const Item& variable, Value to);
  /// Forgets which ends of their ranges the variables of an expression take.
  void blur(const Item& expression) {
    each_variable(expression, [](Value& one) { one.exact = one.dense = false; });
  }
  /// Records that other values now depend on the letters of an expression; returns true if there
  /// are any.
  bool bind(const Item& expression);
  /// Executes a statement that falls through.
  void obey(const StatementNode& statement);
  void let(const LetView& let);
  void read(const StatementNode& statement);
  void input(const InputView& input);

  const Program& program_;
  const Flow& flow_;
  std::vector<Value> known_;        ///< by node
  std::vector<std::uint32_t> runs_; ///< executions, by line of code, on the only path
  Moment now_;
  std::uint32_t line_ = 0; ///< the current line of code
  bool stopped_ = false;   ///< a value of this line stopped the program
  bool quiet_ = false;     ///< the current statement need not run
  bool probing_ = false;   ///< looking ahead: reports nothing
  Trial trial_;
};

} // namespace orb::compiler
