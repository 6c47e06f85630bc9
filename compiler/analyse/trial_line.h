#pragma once

#include "base/diagnostic.h"
#include "compiler/analyse/trial_moment.h"
#include "compiler/analyse/trial_run.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orb::compiler {

/// What a line does to what is known before it, and how its values stop the program.
class TrialLine {
public:
  TrialLine(const Program& program, const Flow& flow)
      : program_(program), flow_(flow), known_(program.nodes.size()), runs_(flow.code.size()) {}

protected:
  /// The program stops here.
  void stop(const Rule& rule, Span span, Message message, Message help = {});
  /// In which round of its loop the line runs; 0 outside of loops, in one within another, and where
  /// the line does not run in each round.
  std::uint32_t round() const;
  /// The first line of the only loop around the line; none where there is no such one.
  std::uint32_t only_loop() const;
  void stop_at(Span span, Message allowed, const Range& range, Message help = {});

  // ---- values

  const TrialValue& value(const Item& item);
  TrialValue compute(const Node& node, std::uint32_t index);
  TrialValue call(const Node& node, std::uint32_t index);
  void check_right(spec::Operator op, Span span, const Range& right);
  /// The element that Y selects, where that is known.
  TrialValue* selected(Span span);
  TrialValue element(Span span);
  void check_value(const Item& item, std::string_view word, const spec::Parameter& parameter);
  std::string in_parentheses(const Item& item) const;
  void set(const Item& variable, const TrialValue& to);
  /// From here on the letters of an expression depend on something else that is known.
  void bind(const Item& expression);
  /// A statement below which the next line comes.
  void obey(const StatementNode& statement);
  void let(const LetView& let);
  void read(const StatementNode& statement);
  void input(const InputView& input);

  const Program& program_;
  const Flow& flow_;
  std::vector<TrialValue> known_;   ///< by node
  std::vector<std::uint32_t> runs_; ///< by line of code, on the only way
  Moment now_;
  std::uint32_t line_ = 0; ///< of code, that runs
  bool stopped_ = false;   ///< by a value of this line
  bool quiet_ = false;     ///< what runs now need not run
  bool probing_ = false;   ///< to see where it leads: nothing is said
  Trial trial_;
};

} // namespace orb::compiler
