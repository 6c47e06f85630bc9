#pragma once

#include "structured/lift/values.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured::lifting {

/// How the assignment begins that stops a program as an `on` does that finds no line: nothing else
/// in a lifted program begins so.
inline constexpr std::string_view stopper = "z[26 + abs(";

/// The `on`s of a numbered program as `select`.
class LiftedChoices {
public:
  LiftedChoices(const compiler::Program& program, const Ways& ways, LiftedNames& names,
                LiftedValues& values, const std::vector<bool>& covered)
      : program_(program), ways_(ways), names_(names), values_(values), covered_(covered) {}

  /// The lines up to the first `case`, and those after the last one. `covered` ones always find a
  /// line; the others stop the program where they do not.
  std::vector<std::string> begin(std::uint32_t step);
  std::vector<std::string> end(std::uint32_t step);
  /// All of `on … gosub`, whose cases are calls.
  std::vector<std::string> calls(std::uint32_t step);

  /// The steps that have a stop, in the order of the text.
  const std::vector<std::uint32_t>& stops() const { return stops_; }
  /// Forgets the stops of what is not written after all.
  void forget_stops_from(std::size_t count) { stops_.resize(count); }

private:
  /// What is chosen by: a variable, or a value that is computed once.
  std::string chosen(std::uint32_t step);
  bool needs_helper(std::uint32_t step) const;
  const compiler::Item& selector(std::uint32_t step) const;

  const compiler::Program& program_;
  const Ways& ways_;
  LiftedNames& names_;
  LiftedValues& values_;
  const std::vector<bool>& covered_;
  std::map<std::uint32_t, std::string> helpers_;
  std::vector<std::uint32_t> stops_;
};

/// The name of the sub that begins at a step.
const std::string& sub_at(const Ways& ways, const LiftedNames& names, std::uint32_t step);

} // namespace orb::structured::lifting
