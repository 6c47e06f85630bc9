#pragma once

#include "compiler/analyse/value.h"
#include "compiler/text/program.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::compiler {

/// An open `for` loop.
struct TrialLoop {
  std::uint32_t letter = 0;
  std::uint32_t body = 0; ///< a line of code
  std::int32_t step = 0;
  Value end;
  friend bool operator==(const TrialLoop&, const TrialLoop&) = default;
};

/// The state of a program between two lines.
struct Moment {
  static constexpr std::uint32_t unknown_data = none - 1;

  std::uint32_t at = 0; ///< the next line of code; none: the program ended
  std::vector<Value> letters;
  std::vector<Value> elements; ///< of Z
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

/// Joins the state of another path to the same line.
void join_into(Moment& into, const Moment& from);

} // namespace orb::compiler
