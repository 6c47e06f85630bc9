#pragma once

#include "compiler/analyse/range.h"
#include "compiler/text/program.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::compiler {

/// The analysis state of a value.
struct TrialValue {
  Range range;
  bool exact = false;  ///< both ends of the range are values that occur, regardless of other values
  bool dense = false;  ///< in addition, so are all values between, as for a sensor
  bool driven = false; ///< caused by the program itself: a time, a place, a speed

  static TrialValue only(std::int32_t value) { return {Range::only(value), true, true}; }
  friend bool operator==(const TrialValue&, const TrialValue&) = default;
};

/// An open `for` loop.
struct TrialLoop {
  std::uint32_t letter = 0;
  std::uint32_t body = 0; ///< a line of code
  std::int32_t step = 0;
  TrialValue end;
  friend bool operator==(const TrialLoop&, const TrialLoop&) = default;
};

/// The state of a program between two lines.
struct Moment {
  static constexpr std::uint32_t unknown_data = none - 1;

  std::uint32_t at = 0; ///< the next line of code; none: the program ended
  std::vector<TrialValue> letters;
  std::vector<TrialValue> elements; ///< of Z
  std::vector<TrialLoop> loops;
  std::vector<std::uint32_t> calls; ///< return addresses
  std::uint32_t data = none;        ///< the statement whose values `read` takes
  std::uint32_t data_next = 0;

  // The path to this state:
  std::uint32_t decision = none;     ///< index of the last decision
  std::vector<std::uint32_t> driven; ///< lines that branched on a value caused by the program

  /// True if the program continues in the same way, whatever the path.
  bool is_like(const Moment& other) const {
    return at == other.at && letters == other.letters && elements == other.elements &&
           loops == other.loops && calls == other.calls && data == other.data &&
           data_next == other.data_next;
  }

  /// Equal for equal states, and collisions are rare.
  std::uint64_t hash() const;
};

/// The state before the first line.
Moment beginning(const Program& program);

/// The result of `left op right`. Its ends occur if the ends of both operands do.
TrialValue sum_of(spec::Operator op, const TrialValue& left, const TrialValue& right);

/// Joins the state of another path to the same line.
void join_into(Moment& into, const Moment& from);

} // namespace orb::compiler
