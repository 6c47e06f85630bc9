#pragma once

#include "compiler/analyse/range.h"
#include "compiler/text/program.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::compiler {

/// What is known of a value.
struct TrialValue {
  Range range;
  bool exact = false;  ///< both ends of the range are values that it takes, whatever others are
  bool dense = false;  ///< and so are all between, as of a sensor
  bool driven = false; ///< the program itself brings it about: a time, a place, a speed

  static TrialValue only(std::int32_t value) { return {Range::only(value), true, true}; }
  friend bool operator==(const TrialValue&, const TrialValue&) = default;
};

/// A `for` that is open.
struct TrialLoop {
  std::uint32_t letter = 0;
  std::uint32_t body = 0; ///< a line of code
  std::int32_t step = 0;
  TrialValue end;
  friend bool operator==(const TrialLoop&, const TrialLoop&) = default;
};

/// A program between two of its lines.
struct Moment {
  static constexpr std::uint32_t unknown_data = none - 1;

  std::uint32_t at = 0; ///< the line of code that comes next; none: it is over
  std::vector<TrialValue> letters;
  std::vector<TrialValue> elements; ///< of Z
  std::vector<TrialLoop> loops;
  std::vector<std::uint32_t> calls; ///< where they come back to
  std::uint32_t data = none;        ///< the statement whose values `read` takes
  std::uint32_t data_next = 0;

  // How it came here:
  std::uint32_t decision = none;     ///< the last one, an index
  std::vector<std::uint32_t> driven; ///< lines that have decided by what the program brings about

  /// Whether the program goes on in the same way, however it came here.
  bool is_like(const Moment& other) const {
    return at == other.at && letters == other.letters && elements == other.elements &&
           loops == other.loops && calls == other.calls && data == other.data &&
           data_next == other.data_next;
  }

  /// Equal for all that is alike, and for hardly anything else.
  std::uint64_t hash() const;
};

/// Before the first line.
Moment beginning(const Program& program);

/// What `left op right` is: the ends of its range are taken where those of both sides are.
TrialValue sum_of(spec::Operator op, const TrialValue& left, const TrialValue& right);

/// Joins what is known on another way that leads to the same line.
void join_into(Moment& into, const Moment& from);

} // namespace orb::compiler
