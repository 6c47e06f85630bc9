#pragma once

#include "compiler/text/program.h"
#include "vm/machine/machine.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Finds where in a line a value can stop the program, and where one did.

namespace orb::run {

/// Stands for no upper bound.
inline constexpr std::int64_t unbounded = INT32_MAX;

/// Kinds of values that can be wrong.
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
  spec::Statement statement{}; ///< the statement, for an argument
  std::size_t argument = 0;    ///< index of the argument
  spec::Function function{};
  std::string name = {};
  std::int64_t least = 0;
  std::int64_t greatest = 0;
  bool turns = false;                  ///< a direction: a full turn makes no difference
  std::uint32_t root = compiler::none; ///< root node of its expression
};

/// The place and value that stopped a machine.
struct Stopped {
  Suspect at; ///< as far as the instruction tells: kind, statement, argument, function
  std::int64_t value = 0;
  std::size_t before = 0; ///< number of such places that the line had passed
  std::size_t all = 0;    ///< number of such places in the line
};

/// Returns the places of a statement and its branches in order of evaluation.
std::vector<Suspect> places_of(const compiler::Program& program,
                               const compiler::StatementNode& statement);

/// Returns the place that stopped the machine; nullopt if no value did.
std::optional<Stopped> where(const vm::Machine& machine, spec::BasicError error);

/// Returns true if a bad value at a place of that kind raises `error`.
bool raises(SuspectKind kind, spec::BasicError error);

bool same_place(const Suspect& a, const Suspect& b);

/// Returns the line of an instruction; null if it has none.
const bytecode::Line* line_of(const bytecode::Chunk& chunk, std::uint32_t index);

} // namespace orb::run
