#pragma once

#include "structured/lift/lifted_values.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured::lifting {

/// The start of the assignment that stops the program as an `on` without a matching line does.
/// Nothing else in a lifted program starts like this.
inline constexpr std::string_view stopper = "z[26 + abs(";

/// Lifts each `on` of a numbered program to a `select`.
class LiftedChoices {
public:
  LiftedChoices(const compiler::Program& program, const ControlFlow& ways, LiftedNames& names,
                LiftedValues& values, const std::vector<bool>& covered)
      : program_(program), ways_(ways), names_(names), values_(values), covered_(covered) {}

  /// The lines up to the first `case`, and those after the last one. If the `on` is not `covered`,
  /// the latter stop the program where it would find no line.
  std::vector<std::string> begin(std::uint32_t step);
  std::vector<std::string> end(std::uint32_t step);
  /// Lifts `on … gosub`, whose cases are calls.
  std::vector<std::string> calls(std::uint32_t step);

  /// The steps with a stop, in text order.
  const std::vector<std::uint32_t>& stops() const { return stops_; }
  /// Discards the stops of code that is written again.
  void forget_stops_from(std::size_t count) { stops_.resize(count); }

private:
  /// The selector: a variable, or a value computed once.
  std::string chosen(std::uint32_t step);
  bool needs_helper(std::uint32_t step) const;
  const compiler::Item& selector(std::uint32_t step) const;

  const compiler::Program& program_;
  const ControlFlow& ways_;
  LiftedNames& names_;
  LiftedValues& values_;
  const std::vector<bool>& covered_;
  std::map<std::uint32_t, std::string> helpers_;
  std::vector<std::uint32_t> stops_;
};

/// The name of the sub that begins at a step.
const std::string& sub_at(const ControlFlow& ways, const LiftedNames& names, std::uint32_t step);

} // namespace orb::structured::lifting
