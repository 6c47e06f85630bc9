#pragma once

#include "structured/lift/lifted_values.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orb::structured::lifting {

/// The conditions of a lifted program, and the statements required before them: values that the
/// robot computes in any case, the ends of loops that cannot be a `for`.
class LiftedTests {
public:
  LiftedTests(const compiler::Program& program, const ControlFlow& ways, LiftedNames& names,
              LiftedValues& values, const std::vector<bool>& prepared)
      : program_(program), ways_(ways), names_(names), values_(values), prepared_(prepared) {}

  /// The condition of the `if` of a step, or its opposite.
  std::string condition(std::uint32_t step, bool negated);
  /// Values to compute before it, because the robot always computes both sides.
  std::vector<std::string> prepare(std::uint32_t step);

  /// The lines that replace a `for`, and its `next`; the condition under which the loop is over.
  std::vector<std::string> begin_loop(std::uint32_t step_of_for);
  std::string count(std::uint32_t step_of_for);
  std::string is_over(std::uint32_t step_of_for, bool negated);

private:
  std::string relation(std::uint32_t step, const compiler::Comparison& comparison,
                       std::uint32_t first, bool negated);
  std::string end_of(std::uint32_t step, const compiler::ForView& loop);
  /// The variable that stores a value of a step.
  const std::string& helper(std::uint32_t step, std::uint32_t nth, std::string_view wish);

  const compiler::Program& program_;
  const ControlFlow& ways_;
  LiftedNames& names_;
  LiftedValues& values_;
  const std::vector<bool>& prepared_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> helpers_;
};

} // namespace orb::structured::lifting
