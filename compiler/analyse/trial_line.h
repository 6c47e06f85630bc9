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
  /// The round of the enclosing loop; 0 outside a loop, in nested loops, and if the line does not
  /// run in every round.
  std::uint32_t round() const;
  /// The first line of the only enclosing loop; none if there is not exactly one.
  std::uint32_t only_loop() const;
  void stop_at(Span span, Message allowed, const Range& range, Message help = {});

  // ---- values

  const Value& value(const Item& item);
  Value compute(const Node& node, std::uint32_t index);
  void check_operand(const spec::FunctionInfo& row, Span span, const Range& operand);
  void check_right(spec::Operator op, Span span, const Range& right);
  /// The element selected by Y, if that is known.
  Value* selected(Span span);
  Value element(Span span);
  void check_value(const Item& item, std::string_view word, const spec::Parameter& parameter);
  std::string in_parentheses(const Item& item) const;
  void set(const Item& variable, const Value& to);
  /// Records that the letters of an expression now depend on other known values.
  void bind(const Item& expression);
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
