#pragma once

#include "compiler/text/program.h"
#include "vm/machine/machine.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Where in a line a value can stop the program, and which one did.

namespace orb::run {

/// Above it there is no bound.
inline constexpr std::int64_t unbounded = INT32_MAX;

/// What can be wrong with a number.
enum class SuspectKind : std::uint8_t {
  Argument,
  Operand,
  Shift,
  Divisor,
  Timer,
  Index,
  Selector,
  Step
};

/// A place in a line whose value can stop the program.
struct Suspect {
  SuspectKind kind = SuspectKind::Argument;
  spec::Statement statement{}; ///< it is an argument of
  std::size_t argument = 0;    ///< which
  spec::Function function{};
  std::string name = {};
  std::int64_t least = 0;
  std::int64_t greatest = 0;
  bool turns = false;                  ///< a direction: one turn more is the same
  std::uint32_t root = compiler::none; ///< of its expression
};

/// The place that a stopped machine was at, and the value there.
struct Stopped {
  Suspect at; ///< as far as an instruction tells: kind, statement, argument, function
  std::int64_t value = 0;
  std::size_t before = 0; ///< such places of the line that it had passed
  std::size_t all = 0;    ///< that the line has
};

/// Those of a statement and its branches, in the order in which the line computes them.
std::vector<Suspect> places_of(const compiler::Program& program,
                               const compiler::StatementNode& statement);

/// Which place has stopped the machine; nothing where no value did.
std::optional<Stopped> where(const vm::Machine& machine, spec::BasicError error);

/// Whether a bad value at a place of that kind raises `error`.
bool raises(SuspectKind kind, spec::BasicError error);

bool same_place(const Suspect& a, const Suspect& b);

/// The line that an instruction belongs to; null where it belongs to none.
const bytecode::Line* line_of(const bytecode::Chunk& chunk, std::uint32_t index);

} // namespace orb::run
